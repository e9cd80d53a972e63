#include "hamjet/report/results.hpp"

#include <fmt/format.h>

#include "../../formats/hdf5/hdf5_jets.hpp"
#include "../../formats/jet_description.hpp"
#include "../../formats/output_formats.hpp"
#include "../../formats/results_names.hpp"

namespace hamjet::io {

std::vector<std::string> generating_function_variables(const PropagationResult& result,
                                                       const GeneratingFunctionKind& kind) {
  const auto names = variable_names(result.scene.system);
  std::vector<std::string> variables;
  for (std::size_t i = 0; i < kind.degrees_of_freedom(); ++i) {
    variables.emplace_back(names[result.problem.components[kind.final_variable(i)]]);
  }
  for (std::size_t i = 0; i < kind.degrees_of_freedom(); ++i) {
    variables.emplace_back(std::string(names[result.problem.components[kind.initial_variable(i)]]) +
                           "0");
  }
  return variables;
}

std::string kind_name(const KindResult& kind) {
  return kind.requested == "auto" ? kind.kind.name() : kind.requested;
}

std::string time_folder(std::size_t index) {
  return fmt::format("{}{:04}", time_folder_head, index + 1);
}

bool is_at_floor(const ExactnessEntry& entry) {
  return entry.floor && entry.residual.absolute <= 10 * entry.floor->absolute;
}

namespace {

/// The formats that keep the jet of each run apart.
void write_jets(const PropagationResult& result, const RunResult& run, OutputDirectory& output) {
  std::optional<StoredJet> stored;
  for (const OutputFormat* format : wanted_formats(result.scene)) {
    if (format->of_results != nullptr || format->of_jet == nullptr) continue;
    if (!stored) {
      stored = describe_jet(result, run);
      stored->jet = run.jet;
    }
    output.write(run.settings.label / std::filesystem::path(format->file), format->of_jet(*stored));
  }
}

/// The polynomials in the scene's coordinates, and in HDF5 where that is asked for.
void write_polynomials(const PropagationResult& result, const RunResult& run,
                       OutputDirectory& output) {
  if (!run.charted || !run.charted->failure.empty()) return;
  StoredJet stored = describe_charted_jet(result, run);
  stored.jet = run.charted->jet;
  const std::filesystem::path file = run.settings.label / std::filesystem::path(polynomials_file);
  output.write(file, polynomials_csv(stored, stored.jet));
  for (const OutputFormat* format : wanted_formats(result.scene)) {
    if (format->ending != hdf5_format.ending) continue;
    output.write(std::filesystem::path(file).replace_extension(format->ending),
                 format->of_jet(stored));
  }
}

/// The jets before the duration, a folder each, in every format that holds one jet.
void write_jets_at_times(const PropagationResult& result, const RunResult& run,
                         OutputDirectory& output) {
  if (run.jets.empty()) return;
  StoredJet stored = describe_jet(result, run);
  for (std::size_t i = 0; i < run.jets.size(); ++i) {
    const JetAtTime& one = run.jets[i];
    const std::filesystem::path folder = std::filesystem::path(run.settings.label) / time_folder(i);
    stored.duration = one.time;
    stored.nominal_final = one.nominal;
    stored.error_by_degree = one.error_estimate;
    stored.jet = one.jet;
    output.write(folder / csv_format.file, csv_format.of_jet(stored));
    for (const OutputFormat* format : wanted_formats(result.scene)) {
      if (format->of_jet != nullptr) output.write(folder / format->file, format->of_jet(stored));
    }
  }
}

}  // namespace

std::string write_results(const PropagationResult& result, const std::string& figure,
                          OutputDirectory& output) {
  const std::vector<const OutputFormat*> formats = wanted_formats(result.scene);
  for (const RunResult& run : result.runs) {
    if (!run.failure.empty()) continue;
    const std::filesystem::path folder = run.settings.label;
    output.write(folder / "jet.csv", jet_csv(result, run));
    write_jets(result, run, output);
    write_jets_at_times(result, run, output);
    write_polynomials(result, run, output);
    output.write(folder / "nominal.csv", nominal_csv(result, run));
    for (const OutputFormat* format : formats) {
      if (format->of_nominal != nullptr) {
        output.write(folder / format->file, format->of_nominal(result, run));
      }
    }
    if (run.along_time) output.write(folder / "along_time.csv", along_time_csv(result, run));
    for (const KindResult& kind : run.kinds) {
      if (!kind.generating_function) continue;
      output.write(folder / ("generating_function_" + kind_name(kind) + ".csv"),
                   generating_function_csv(result, kind));
    }
  }
  if (!result.relative_hamiltonians.empty()) {
    output.write("relative_hamiltonian.csv", relative_hamiltonian_csv(result));
  }
  for (const OutputFormat* format : formats) {
    if (format->of_results != nullptr) output.write(format->file, format->of_results(result));
  }
  if (!figure.empty()) output.write("figure.svg", figure);
  output.write("summary.json", summary_json(result));
  return output.commit();
}

}  // namespace hamjet::io
