#include "deviation_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "../../app/refusal.hpp"
#include "../../app/stored_chief.hpp"
#include "../../report/study_description.hpp"
#include "../../store/text_file.hpp"
#include "../../studies/formation/formation_problem.hpp"
#include "../../text/scene_message.hpp"
#include "../../text/scene_refusal.hpp"
#include "eval_source.hpp"
#include "hamjet/error.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"

namespace hamjet::cli {
namespace {

/// The scene's deputy: its row, and the deviations of all of the jet's variables behind positions
/// and momenta.
struct DeputyRow {
  std::vector<double> row;
  std::vector<double> parameters;
};

DeputyRow deputy_row(const EvalOptions& options, const io::StoredJet& stored,
                     const EvalCoordinates& coordinates) {
  const RunOptions named = scene_named(options, *options.deputy);
  const std::string& file = *named.scene_file;
  Scene scene;
  try {
    // As the jet is: stored, or integrated in the chief's own units.
    scene = read_scene(named, is_of_scene(options) ? io::SceneUnits::chiefs : io::SceneUnits::told);
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("--deputy: {}", error.what()));
  }
  io::require_table(io::study_of_table("deputy"), scene, file);
  if (!is_about_chief(stored, scene)) {
    io::refuse_scene(
        file, "nominal",
        fmt::format("another orbit than that of the jet {}, must be the scene that it was "
                    "made from",
                    io::printable(stored.label)));
  }
  const ChiefFrame frame(scene.nominal, {scene.units.length_km * 1000, scene.units.time_s},
                         scene.deputy->frame);
  std::vector<double> deviation = frame.deviation(scene.deputy->start);
  DeputyRow deputy;
  if (is_of_scene(options)) {
    // The polynomials are of spacecraft like the deputy of their own scene.
    if (*options.deputy != options.directory && !is_like_chief(scene)) {
      io::refuse_scene(file, "deputy",
                       fmt::format("differs from its chief in {}, and the polynomials are of "
                                   "another scene, must be like its chief, or evaluated with its "
                                   "own scene",
                                   differing_parameters(scene)[0]));
    }
    return {coordinates.initial_row(deviation), {}};
  }
  const std::vector<std::string_view> names = stored.variable_names();
  const auto is_variable = [&](std::string_view name) {
    return std::any_of(stored.variables.begin(), stored.variables.end(),
                       [&](std::size_t v) { return names[v] == name; });
  };
  for (const std::string& name : differing_parameters(scene)) {
    if (is_variable(name)) continue;
    io::refuse_scene(file, "deputy",
                     fmt::format("differs from its chief in {}, which the jet {} has not as a "
                                 "variable, must be like its chief, or beside a jet with {} in "
                                 "jet.variables, or evaluated with the scene in place of results",
                                 name, io::printable(stored.label), name));
  }
  for (std::size_t v = deviation.size(); v < names.size(); ++v) {
    deviation.push_back(parameter_difference(scene, names[v]));
    if (is_variable(names[v])) deputy.parameters.push_back(deviation.back());
  }
  deputy.row = coordinates.initial_row(deviation);
  return deputy;
}

/// The row that the command line gives.
std::vector<double> given_row(const std::string& text, const EvalCoordinates& coordinates) {
  const std::vector<std::string_view>& columns = coordinates.initial_columns();
  std::vector<std::string_view> fields;
  io::split_line(text, fields);
  if (fields.size() != columns.size()) {
    refuse(fmt::format("--deviation: must be {} numbers between commas, {}, got {}", columns.size(),
                       fmt::join(columns, ","), io::in_quotes(text)));
  }
  std::vector<double> row;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const auto number = io::finite_number(fields[i]);
    if (!number) {
      refuse(fmt::format("--deviation: {} must be a finite number, got {}", columns[i],
                         io::in_quotes(fields[i])));
    }
    row.push_back(*number);
  }
  return row;
}

}  // namespace

DeviationRows::DeviationRows(const EvalOptions& options, const io::StoredJet& stored,
                             const EvalCoordinates& coordinates)
    : options_(options), coordinates_(coordinates) {
  if (options.deviations) {
    input_ = *options.deviations == standard_input
                 ? io::InputStream::standard_input()
                 : io::InputStream(std::filesystem::path(*options.deviations));
    rewind();
    return;
  }
  DeputyRow given = options.deputy ? deputy_row(options, stored, coordinates)
                                   : DeputyRow{given_row(*options.deviation, coordinates), {}};
  row_ = {given.row.size(), std::move(given.row)};
  parameters_ = std::move(given.parameters);
}

void DeviationRows::keep() {
  if (input_) input_->keep();
}

void DeviationRows::rewind() {
  is_at_end_ = false;
  if (!input_) return;
  if (reader_) input_->rewind();
  reader_.emplace(input_->name(), coordinates_.initial_columns(),
                  [this](std::span<char> bytes) { return input_->read(bytes); });
}

io::NumberTable DeviationRows::read(std::size_t most_rows) {
  if (!input_) return std::exchange(is_at_end_, true) ? io::NumberTable{row_.columns, {}} : row_;
  io::NumberTable part = reader_->read(most_rows);
  // Half of an old file and half of a new one can look like a good file.
  if (part.rows() == 0) input_->require_unchanged();
  return part;
}

std::vector<double> DeviationRows::variables(const EvalCoordinates& coordinates,
                                             const io::NumberTable& part, std::size_t row) const {
  try {
    std::vector<double> variables = coordinates.variables(part.row(row));
    // They come last; frames do not tell them, canonical rows have them already.
    std::copy(parameters_.rbegin(), parameters_.rend(), variables.rbegin());
    return variables;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::usage) throw;
    if (options_.deviation) refuse(fmt::format("--deviation: {}", error.what()));
    if (options_.deputy) io::refuse_scene(*options_.deputy, "deputy", error.what());
    throw Error(ErrorKind::input_output,
                fmt::format("{}:{}: {}", input_->name(), part.line(row), error.what()));
  }
}

}  // namespace hamjet::cli
