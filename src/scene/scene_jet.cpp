#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "../studies/earth_system.hpp"
#include "../studies/harmonic_parameter.hpp"
#include "../text/scene_message.hpp"
#include "hamjet/error.hpp"
#include "scene_relative_motion.hpp"

namespace hamjet::io {
namespace {

constexpr std::int64_t most_arcs = 1000;

/// C(variables + order, order), the number of monomials up to the order. It is exact below 2^53;
/// beyond that only its magnitude matters.
double number_of_coefficients(std::size_t variables, std::int64_t order) {
  double count = 1;
  for (std::size_t k = 1; k <= variables; ++k) {
    count = count * (static_cast<double>(order) + static_cast<double>(k)) / static_cast<double>(k);
  }
  return count;
}

std::string with_unit(double bytes) {
  constexpr std::string_view units[] = {"bytes", "kB", "MB", "GB", "TB", "PB", "EB"};
  std::size_t unit = 0;
  for (; bytes >= 1000 && unit + 1 < std::size(units); ++unit) bytes /= 1000;
  return fmt::format("{:.3g} {}", bytes, units[unit]);
}

[[noreturn]] void throw_order_too_large(const TableReader& jet, std::int64_t order,
                                        std::size_t variables, Precision precision) {
  const double count = number_of_coefficients(variables, order);
  const double bytes_each =
      precision == Precision::double_precision ? sizeof(double) : sizeof(Extended);
  const std::string count_text =
      count < 0x1p53 ? fmt::format("{:.0f}", count) : fmt::format("{:.3g}", count);
  throw Error(ErrorKind::too_large,
              fmt::format("{}: too large, got {}, which takes C({}+{}, {}) = {} coefficients, "
                          "{} for each series, must be an integer from 1 to {}",
                          jet.head("order"), order, variables, order, order, count_text,
                          with_unit(count * bytes_each), largest_order));
}

int read_order(const TableReader& jet, std::size_t variables, Precision precision) {
  if (!jet.has("order")) return JetSettings().order;
  // An order below 1 is a mistake in the scene. A very high order is not: it asks for more than a
  // machine can hold.
  const std::optional<std::int64_t> asked = jet.integer_if_any("order");
  if (asked && *asked > largest_order) throw_order_too_large(jet, *asked, variables, precision);
  return static_cast<int>(jet.integer("order"));
}

/// Names that `jet.variables` may have beside those of the state.
std::vector<std::string> names_of_parameters(const SystemSettings& system) {
  std::vector<std::string> names;
  const std::vector<std::string>& known = state_parameters(system);
  const auto add = [&](const std::string& name) {
    if (std::find(known.begin(), known.end(), name) == known.end()) names.push_back(name);
  };
  if (system.own_text) {
    for (const NamedText& parameter : system.own_text->parameters) add(parameter.name);
  }
  if (system.earth) {
    for (const EarthParameter& parameter : earth_parameters()) {
      if (!parameter.missing || !parameter.missing(system)) add(parameter.name);
    }
    names.push_back(HarmonicParameter::names_of_field(system.earth->degree, system.earth->order));
  }
  return names;
}

std::vector<std::size_t> read_variables(const TableReader& jet, const SystemSettings& system,
                                        const std::vector<std::string_view>& names) {
  std::vector<std::size_t> variables(names.size());
  if (!jet.has("variables")) {
    std::iota(variables.begin(), variables.end(), std::size_t{0});
    return variables;
  }
  variables.clear();
  const std::vector<std::string> given = jet.texts("variables");
  for (std::size_t i = 0; i < given.size(); ++i) {
    const auto name = std::find(names.begin(), names.end(), given[i]);
    if (name == names.end()) {
      const std::vector<std::string> parameters = names_of_parameters(system);
      std::vector<std::string_view> right = names;
      right.insert(right.end(), parameters.begin(), parameters.end());
      jet.fail_element("variables", i,
                       fmt::format("unknown variable, got {}, must be one of: {}",
                                   in_quotes(given[i]), listed(right)));
    }
    const auto index = static_cast<std::size_t>(name - names.begin());
    if (std::find(variables.begin(), variables.end(), index) != variables.end()) {
      jet.fail_element(
          "variables", i,
          fmt::format("duplicate variable, got {} again, must be there once", in_quotes(given[i])));
    }
    variables.push_back(index);
  }
  std::sort(variables.begin(), variables.end());
  return variables;
}

/// jet.arcs: a number, or "auto".
std::optional<std::size_t> read_arcs(const TableReader& jet) {
  if (!jet.has("arcs")) return 1;
  const std::optional<std::int64_t> asked = jet.integer_if_any("arcs");
  if (asked && *asked >= 1 && *asked <= most_arcs) return static_cast<std::size_t>(*asked);
  if (jet.found("arcs") == "the string \"auto\"") return std::nullopt;
  jet.fail("arcs", fmt::format("out of range, got {}, must be \"auto\" or an integer from 1 to {}",
                               jet.found("arcs"), most_arcs));
}

}  // namespace

namespace {

/// The help of the key `variables`. The string is kept because the table only refers to its texts.
const std::string& help_of_variables() {
  static const std::string text = [] {
    std::string words =
        "the variables to expand in: `x` to `pz`, `q` and `p`, or `q1`, ..., `p1`, ...; of a model "
        "`own` "
        "by "
        "its own names and parameters, without choice the states of a vector field; about the real "
        "Earth also";
    for (const EarthParameter& parameter : earth_parameters()) {
      words += fmt::format(" `{}`,", parameter.name);
    }
    return words +
           " coefficients of the field: `J2` and so on, not normalised, `C22`, `S31`, `C_10_3`, "
           "normalised";
  }();
  return text;
}

}  // namespace

const TableDescription& jet_table() {
  const auto other_duration = absent::other("another duration");
  // Only orbits have periods.
  std::vector<SceneKey> times = transfer_time_keys(absent::other("the duration alone"));
  for (SceneKey& key : times) {
    if (key.name == "times_orbits") key.owners = {orbits};
  }
  static const TableDescription table = {
      joined<SceneKey>(
          {{{"order", form::integer(1, largest_order), absent::value(JetSettings().order),
             "degree of the Taylor polynomials in the initial deviations"},
            {"variables", form::words("array of the model's variables", form::array(form::text())),
             absent::other("all"), help_of_variables()},
            {"duration_s", form::number(), other_duration, "negative is backwards"},
            {"duration_canonical", form::number(), other_duration, "the same"},
            {"arcs",
             form::words(fmt::format("integer from 1 to {}, or `\"auto\"`", most_arcs),
                         form::integer(1, most_arcs)),
             absent::value(1),
             "pieces of the flow, computed on threads; `auto` decides from counts"},
            {"symmetry", form::choice({"none", "rotation", "rotation-and-time"}),
             absent::value("rotation"),
             "left out of the integration and put back: `rotation` about the field's axis exactly, "
             "the shift in time besides to about the error of integration, which a run then tells"},
            {"coordinates",
             form::choice({jet_coordinates_names.begin(), jet_coordinates_names.end()}),
             absent::value("cartesian"),
             "coordinates of the polynomials that predict deputies: `flow-box` (time and energy) "
             "reaches furthest, `auto` measures which does",
             {orbits}},
            {"end_coordinates",
             form::choice({jet_coordinates_names.begin(), jet_coordinates_names.end()}),
             absent::other("as `coordinates`"),
             "coordinates of the polynomials' results, where these are others than at the start; "
             "`flow-box` and `auto` are for both ends",
             {orbits}},
            {"duration_orbits",
             form::number(),
             other_duration,
             "the same in periods of the nominal",
             {orbits}}},
           times}),
      "At the times, one integration by `gauss` writes further jets, into a folder each, which "
      "`hamjet eval --time` takes."};
  return table;
}

double read_duration(const TableReader& table, bool has_orbits, const Nominal& nominal) {
  std::vector<std::string_view> keys = {"duration_s", "duration_orbits", "duration_canonical"};
  if (!has_orbits) std::erase(keys, "duration_orbits");
  const std::string_view key = table.exactly_one_of(keys);
  const double given = table.number(key);
  double duration = 0;
  if (key == "duration_canonical") {
    duration = nominal.time_of_canonical(given);
  } else if (key == "duration_s") {
    duration = nominal.scale.time_of_s(given);
  } else if (key == "duration_orbits") {
    if (!nominal.period_s) {
      table.fail(key,
                 fmt::format("no period, got {} periods of an orbit that is not elliptic, must "
                             "be duration_s or duration_canonical",
                             table.found(key)));
    }
    duration = convert<double>(Extended(given) * *nominal.period_s / nominal.scale.time_s);
  }
  if (!std::isfinite(duration) || (duration == 0 && given != 0)) {
    table.fail(key,
               fmt::format("out of range, got {}, which is {} in canonical units, must be 0 or "
                           "within binary64 there",
                           table.found(key), duration));
  }
  return duration;
}

JetSettings read_jet(const TableReader& jet, const SystemSettings& system, Precision precision,
                     const Nominal& nominal) {
  check_keys_of_model(jet, system.model);
  const std::vector<std::string_view> names = variable_names(system);
  JetSettings settings;
  settings.order = read_order(jet, names.size(), precision);
  settings.variables = read_variables(jet, system, names);
  const bool has_adjoint = system.own_text && !system.own_text->is_hamiltonian();
  if (has_adjoint && !jet.has("variables")) settings.variables.resize(names.size() / 2);
  settings.duration = read_duration(jet, is_orbit(system.model), nominal);
  settings.arcs = read_arcs(jet);
  jet.read_if_any("symmetry", settings.symmetry);
  jet.read_if_any("coordinates", settings.coordinates.start);
  settings.coordinates.end = settings.coordinates.start;
  jet.read_if_any("end_coordinates", settings.coordinates.end);
  const bool has_parameter = !state_parameters(system).empty();
  if (has_parameter && has_time_shift(settings.symmetry)) {
    jet.fail("symmetry",
             fmt::format("beside the variable {}, got {}, must be \"rotation\" or \"none\": the "
                         "energy of a shift in time depends on the parameter",
                         state_parameters(system)[0], jet.found("symmetry")));
  }
  for (const std::string_view key : {"coordinates", "end_coordinates"}) {
    if (!has_parameter || !jet.has(key) || jet.text(key) == "cartesian") continue;
    jet.fail(key, fmt::format("beside a parameter among the variables, got {}, must be "
                              "\"cartesian\"",
                              jet.found(key)));
  }
  if (!settings.coordinates.fit_each_other()) {
    jet.fail("end_coordinates",
             fmt::format(
                 "different at the two ends, got {} to {}, must be the same at both ends where one "
                 "of them is flow-box or auto",
                 in_quotes(name_of(settings.coordinates.start)),
                 in_quotes(name_of(settings.coordinates.end))));
  }
  return settings;
}

}  // namespace hamjet::io
