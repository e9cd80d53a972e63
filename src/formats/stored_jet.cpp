#include "hamjet/formats/stored_jet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "../integrators/momentum_unit.hpp"
#include "../maps/evaluation_error.hpp"
#include "../store/json_reader.hpp"
#include "../store/result_set.hpp"
#include "../store/text_file.hpp"
#include "../text/scene_message.hpp"
#include "hamjet/error.hpp"
#include "hamjet/version.hpp"
#include "jet_description.hpp"
#include "stored_jet_source.hpp"

namespace hamjet::io {
namespace {

double finite_number(const JsonReader& value) {
  const double number = value.number();
  if (!std::isfinite(number)) value.fail("must be finite");
  return number;
}

double positive_number(const JsonReader& value) {
  const double number = finite_number(value);
  if (!(number > 0)) value.fail("must be positive");
  return number;
}

std::vector<double> state(const JsonReader& value, const std::vector<std::size_t>& dimensions) {
  std::vector<double> numbers = value.list(finite_number);
  if (std::find(dimensions.begin(), dimensions.end(), numbers.size()) == dimensions.end()) {
    value.fail(
        fmt::format("must have {} numbers, has {}", fmt::join(dimensions, " or "), numbers.size()));
  }
  return numbers;
}

/// The number of parameters with which the states of a summary end.
std::size_t parameters_of(const JsonReader& root, SystemModel model) {
  if (!root.has("state_parameters")) return 0;
  const JsonReader json = root.at("state_parameters");
  const auto count = json.integer<std::size_t>();
  if (count > most_state_parameters || (count > 0 && !has_state_parameters(model))) {
    json.fail(
        fmt::format("must be 0 to {}, of a model that has parameters", most_state_parameters));
  }
  return count;
}

/// Indices of variables, which must ascend as the writer has them.
std::vector<std::size_t> indices(const JsonReader& value,
                                 const std::vector<std::string_view>& names) {
  const auto result = value.list([&](const JsonReader& name) { return name.index_in(names); });
  if (result.empty()) value.fail("must not be empty");
  if (std::adjacent_find(result.begin(), result.end(), std::greater_equal<>()) != result.end()) {
    value.fail("must ascend in the order of the state");
  }
  return result;
}

/// A label is the name of a folder; a damaged label must not lead elsewhere.
void require_plain(const JsonReader& label) {
  const std::string text = label.text();
  if (text.empty() || text[0] == '.' || text.find_first_of(std::string("/\0", 2)) != text.npos) {
    label.fail("must be the name of a folder of the results");
  }
}

/// The wanted run; a run that failed is refused.
JsonReader choose_run(const JsonReader& root, const std::optional<std::string>& label) {
  const auto runs = root.at("runs").list([](const JsonReader& run) { return run; });
  std::vector<std::string> labels;
  for (const JsonReader& run : runs) {
    require_plain(run.at("label"));
    labels.push_back(run.at("label").text());
    const std::string failure = run.at("error").text_or_empty();
    if (label ? labels.back() == *label : failure.empty()) {
      if (!failure.empty()) {
        run.at("error").fail(fmt::format("the run {} has no result: {}", printable(labels.back()),
                                         printable(failure, 300)));
      }
      return run;
    }
  }
  if (!label) root.at("runs").fail("no run has a result");
  throw Error(ErrorKind::usage, fmt::format("no run has the label {}; {}", printable(*label),
                                            suggestion(*label, {labels.begin(), labels.end()})));
}

/// Relative errors by degree: measured against a reference or, without one, estimated.
std::vector<double> coefficient_errors(const JsonReader& run) {
  for (const char* key : {"error_by_degree", "error_estimate_by_degree"}) {
    if (!run.has(key) || run.at(key).is_null()) continue;
    return run.at(key).list(
        [](const JsonReader& entry) { return finite_number(entry.at("relative")); });
  }
  return {};
}

void require_this_version(const JsonReader& root) {
  if (root.has("study")) root.at("study").fail("the results of this study have no flow jet");
  const std::string stored = root.at("version").text();
  if (stored != version) {
    root.at("version").fail(
        fmt::format("the results are of hamjet {}, this is {}; run the scene again",
                    printable(stored), version));
  }
}

std::optional<EphemerisSettings> read_stored_ephemeris(const JsonReader& json) {
  if (json.is_null()) return std::nullopt;
  EphemerisSettings ephemeris;
  ephemeris.epoch = json.at("epoch").text();
  ephemeris.time_system = json.at("time_system").text();
  ephemeris.reference_frame = json.at("reference_frame").text();
  ephemeris.reference_frame_epoch = json.at("reference_frame_epoch").text_or_empty();
  ephemeris.center_name = json.at("center_name").text();
  return ephemeris;
}

}  // namespace

int StoredJet::momentum_exponent() const {
  return natural_momentum_exponent(is_orbit(model), nominal_initial);
}

namespace {

/// What a summary says about a run, apart from the coefficients.
struct DescribedRun {
  StoredJet stored;  ///< description of the jet at the duration
  int order = 0;
  JsonReader json;
};

std::vector<std::string> state_names(const JsonReader& json, const StoredJet& stored) {
  auto names = json.list([](const JsonReader& name) { return name.text(); });
  if (!has_state_parameters(stored.model) || names.size() != stored.nominal_initial.size()) {
    json.fail(fmt::format("must have {} names, of a model that has its own",
                          stored.nominal_initial.size()));
  }
  return names;
}

DescribedRun read_description(const JsonReader& root, const std::optional<std::string>& label) {
  require_this_version(root);
  StoredJet stored;
  stored.scene = root.at("scene").text();
  stored.model = root.at("model").one_of<SystemModel>(model_names());
  stored.precision = root.at("precision").one_of<Precision>({"double", "extended"});
  stored.units = {positive_number(root.at("units").at("length_km")),
                  positive_number(root.at("units").at("time_s"))};
  if (root.has("ephemeris")) stored.ephemeris = read_stored_ephemeris(root.at("ephemeris"));
  stored.duration = finite_number(root.at("duration_canonical"));
  if (root.has("start_canonical")) {
    stored.start_time = ClockTime(finite_number(root.at("start_canonical")));
  }
  if (root.has("autonomous")) stored.is_autonomous = root.at("autonomous").boolean();
  stored.parameters = parameters_of(root, stored.model);
  stored.nominal_initial =
      state(root.at("nominal_initial"), possible_dimensions(stored.model, stored.parameters));
  if (root.has("state_names")) stored.own_names = state_names(root.at("state_names"), stored);
  const auto names = stored.variable_names();
  stored.components = indices(root.at("components"), names);
  stored.variables = indices(root.at("variables"), names);
  if (!std::includes(stored.components.begin(), stored.components.end(), stored.variables.begin(),
                     stored.variables.end())) {
    root.at("variables").fail("must be among the components");
  }
  if (root.has("eval")) {
    stored.eval_tolerance_m = positive_number(root.at("eval").at("tolerance_m"));
  }
  const int order = root.at("order").integer<int>();
  const JsonReader count = root.at("coefficients_per_component");
  // The canonical duration is a product of quotients, exact but for its last digits.
  if (order < 1 || order > 60 ||
      count.number() != std::round(SeriesSpace::monomial_count(stored.variables.size(), order))) {
    count.fail(fmt::format("is not the number of coefficients of order {} in {} variables", order,
                           stored.variables.size()));
  }

  const JsonReader run = choose_run(root, label);
  stored.label = run.at("label").text();
  stored.nominal_final = state(run.at("nominal_final"), {names.size()});
  stored.error_by_degree = coefficient_errors(run);
  return {stored, order, run};
}

/// The run's jets before the duration, as the summary describes them.
std::vector<JsonReader> jets_before(const JsonReader& run) {
  if (!run.has("jets")) return {};
  return run.at("jets").list([](const JsonReader& jet) {
    require_plain(jet.at("folder"));
    return jet;
  });
}

/// The description of the jet at one of these times.
DescribedRun at_time(const DescribedRun& run, const JsonReader& jet) {
  DescribedRun one = run;
  one.stored.duration = finite_number(jet.at("time_canonical"));
  one.stored.nominal_final = state(jet.at("nominal"), {run.stored.variable_names().size()});
  one.stored.error_by_degree = coefficient_errors(jet);
  one.json = jet;
  return one;
}

StoredJet with_coefficients(DescribedRun run, const std::filesystem::path& file,
                            const FileReader& read, const CoefficientSource& source) {
  StoredJet& stored = run.stored;
  const auto names = stored.variable_names();
  stored.jet = source.read({printable_path(file), names, stored.components, stored.variables,
                            run.order, stored.precision},
                           read(file));
  const JsonReader nominal = run.json.at(run.json.has("nominal") ? "nominal" : "nominal_final");
  for (std::size_t c = 0; c < stored.components.size(); ++c) {
    const std::size_t i = stored.components[c];
    if (static_cast<double>(stored.jet[c].constant()) != stored.nominal_final[i]) {
      nominal.fail(fmt::format("the {} is not that of {}: the files are of different runs",
                               names[i], printable_path(file)));
    }
  }
  return std::move(stored);
}

/// Reads files of a directory of results. Their checksums are judged at the end, because the
/// reader's own checks describe a fault better.
template <class Read>
auto read_verified(const std::filesystem::path& directory, const Read& read) {
  ResultSet set(directory, "summary.json");
  auto result = read([&](const std::filesystem::path& file) {
    if (file == set.path()) return set.summary();
    return set.read(file.lexically_relative(directory).generic_string());
  });
  set.verify();
  return result;
}

[[noreturn]] void refuse_time(const DescribedRun& run, const std::vector<DescribedRun>& all,
                              double time_s) {
  constexpr std::size_t most_named = 12;
  std::vector<std::string> times;
  for (const DescribedRun& one : all) {
    times.push_back(fmt::format("{:.12g}", one.stored.duration * one.stored.units.time_s));
  }
  const bool has_more = times.size() > most_named;
  if (has_more) times.erase(times.begin() + most_named - 1, times.end() - 1);
  const std::string listed =
      has_more ? fmt::format("{}, ..., {}", fmt::join(times.begin(), times.end() - 1, ", "),
                             times.back())
               : fmt::format("{}", fmt::join(times, ", "));
  throw Error(ErrorKind::usage,
              fmt::format("no jet of the run {} at {:.12g} s, must be one of {} s; others take a "
                          "scene with jet.times_s",
                          printable(run.stored.label), time_s, listed));
}

/// The field and the chart of a flow box.
StoredFlowBox read_flow_box(const JsonReader& json) {
  StoredFlowBox box;
  const auto chart = chart_of(json.at("section").text());
  if (!chart || *chart == ChartName::cartesian) json.at("section").fail("must name a chart");
  box.section = *chart;
  box.field.radius = finite_number(json.at("field").at("radius_canonical"));
  const std::vector<double> J = json.at("field").at("J").list(finite_number);
  constexpr std::size_t count = ZonalCoefficients::count;
  if (J.size() != count) json.at("field").at("J").fail(fmt::format("must have {} numbers", count));
  box.field.J = ZonalCoefficients(std::span(J).first<count>());
  if (!box.has_radius_of_field()) {
    json.at("field").at("radius_canonical").fail(std::string(radius_of_field_rule));
  }
  return box;
}

/// The description of a run's polynomials in the coordinates of its scene.
DescribedRun with_polynomials(const DescribedRun& run, const JsonReader& json) {
  DescribedRun one = run;
  const std::vector<std::string_view> names(jet_coordinates_names.begin(),
                                            jet_coordinates_names.end());
  StoredJet& stored = one.stored;
  stored.coordinates = {json.at("coordinates").one_of<JetCoordinates>(names),
                        json.at("end_coordinates").one_of<JetCoordinates>(names)};
  if (!is_orbit(stored.model) || stored.variables.size() != 6) {
    json.fail("are of orbits in all six variables");
  }
  if (!stored.coordinates.fit_each_other() || stored.coordinates == JetCoordinates::automatic) {
    json.at("coordinates").fail("must be those of polynomials");
  }
  if (stored.coordinates == JetCoordinates::flow_box) stored.flow_box = read_flow_box(json);
  stored.nominal_final = state(json.at("nominal_final"), {6});
  if (stored.flow_box) stored.error_by_degree = coefficient_errors(json);
  one.json = json;
  return one;
}

}  // namespace

std::optional<StoredJet> read_stored_polynomials(const std::filesystem::path& directory,
                                                 const std::optional<std::string>& label) {
  std::error_code none;
  if (!std::filesystem::is_directory(directory, none)) return std::nullopt;
  return read_verified(directory, [&](const FileReader& read) -> std::optional<StoredJet> {
    const std::filesystem::path summary = directory / "summary.json";
    const std::string summary_name = printable_path(summary);
    const nlohmann::json json = JsonReader::parse(read(summary), summary_name);
    const DescribedRun run = read_description({json, summary_name}, label);
    if (!run.json.has("polynomials")) return std::nullopt;
    const JsonReader polynomials = run.json.at("polynomials");
    if (!polynomials.at("error").is_null()) return std::nullopt;
    DescribedRun one = with_polynomials(run, polynomials);
    const std::filesystem::path file = directory / one.stored.label / polynomials_file;
    one.stored.jet = read_polynomials_csv(one.stored, one.order, printable_path(file), read(file));
    return std::move(one.stored);
  });
}

bool is_at(const StoredJet& stored, double time_s) {
  const double stored_s = stored.duration * stored.units.time_s;
  return std::abs(time_s - stored_s) <= 1e-9 * std::abs(stored_s);
}

StoredJet read_stored_jet(const std::filesystem::path& directory,
                          const std::optional<std::string>& label) {
  return read_verified(
      directory, [&](const FileReader& read) { return read_stored_jet(directory, label, read); });
}

StoredJet read_stored_jet(const std::filesystem::path& directory,
                          const std::optional<std::string>& label, const FileReader& read) {
  return read_stored_jet(directory, label, read, {{}, read_coefficients});
}

StoredJet read_stored_jet(const std::filesystem::path& directory,
                          const std::optional<std::string>& label, const FileReader& read,
                          const CoefficientSource& source) {
  const std::filesystem::path summary = directory / "summary.json";
  const std::string summary_name = printable_path(summary);
  const nlohmann::json json = JsonReader::parse(read(summary), summary_name);
  DescribedRun run = read_description({json, summary_name}, label);
  if (!source.time_folder.empty()) {
    const std::vector<JsonReader> jets = jets_before(run.json);
    const auto found = std::find_if(jets.begin(), jets.end(), [&](const JsonReader& jet) {
      return jet.at("folder").text() == source.time_folder;
    });
    if (found == jets.end()) {
      run.json.fail(fmt::format("has no jet in the folder {}", printable(source.time_folder)));
    }
    run = at_time(run, *found);
  }
  const std::filesystem::path file =
      source.file.empty() ? directory / run.stored.label / "jet.csv" : source.file;
  return with_coefficients(std::move(run), file, read, source);
}

std::vector<StoredJet> read_stored_jets(const std::filesystem::path& directory,
                                        const std::optional<std::string>& label,
                                        const WantedTimes& wanted) {
  return read_verified(directory, [&](const FileReader& read) {
    const std::filesystem::path summary = directory / "summary.json";
    const std::string summary_name = printable_path(summary);
    const nlohmann::json json = JsonReader::parse(read(summary), summary_name);
    const DescribedRun run = read_description({json, summary_name}, label);
    std::vector<DescribedRun> all;
    for (const JsonReader& jet : jets_before(run.json)) all.push_back(at_time(run, jet));
    all.push_back(run);
    const auto with_file = [&](const DescribedRun& one) {
      std::filesystem::path folder = directory / run.stored.label;
      if (one.json.has("folder")) folder /= one.json.at("folder").text();
      return with_coefficients(one, folder / "jet.csv", read, {{}, read_coefficients});
    };
    std::vector<StoredJet> jets;
    if (wanted.all) {
      for (const DescribedRun& one : all) jets.push_back(with_file(one));
      return jets;
    }
    for (const double time_s : wanted.seconds) {
      const auto found = std::find_if(all.begin(), all.end(), [&](const DescribedRun& one) {
        return is_at(one.stored, time_s);
      });
      if (found == all.end()) refuse_time(run, all, time_s);
      jets.push_back(with_file(*found));
    }
    return jets;
  });
}

std::vector<Series<double>> evaluation_error(const StoredJet& stored,
                                             const std::vector<Series<double>>& map, int degree) {
  const std::size_t n = (map.size() - stored.parameters) / 2;
  const auto kinds = kinds_of_variables(stored.variables, stored.degrees_of_freedom(), n);
  const int exponent = stored.momentum_exponent();
  const std::vector<Series<double>> comparable = in_momentum_unit(map, kinds, n, exponent);
  return in_momentum_unit(hamjet::evaluation_error(comparable, degree, stored.error_by_degree),
                          kinds, n, -exponent);
}

}  // namespace hamjet::io
