#include "hamjet/report/results.hpp"

#include "../../formats/dace_text.hpp"
#include "../../formats/hdf5_jets.hpp"
#include "../../formats/jet_description.hpp"
#include "../../formats/results_names.hpp"
#include "orbit_ephemeris.hpp"

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

bool is_at_floor(const ExactnessEntry& entry) {
  return entry.floor && entry.residual.absolute <= 10 * entry.floor->absolute;
}

std::string write_results(const PropagationResult& result, const std::string& figure,
                          OutputDirectory& output) {
  for (const RunResult& run : result.runs) {
    if (!run.failure.empty()) continue;
    const std::filesystem::path folder = run.settings.label;
    output.write(folder / "jet.csv", jet_csv(result, run));
    if (result.scene.output.dace) {
      output.write(folder / "jet.dace",
                   dace_text(run.jet, jet_notes(describe_jet(result, run), result.scene.order)));
    }
    output.write(folder / "nominal.csv", nominal_csv(result, run));
    if (result.scene.output.oem) output.write(folder / "nominal.oem", nominal_oem(result, run));
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
  if (result.scene.output.hdf5) output.write("jets.h5", jets_hdf5(result));
  if (!figure.empty()) output.write("figure.svg", figure);
  output.write("summary.json", summary_json(result));
  return output.commit();
}

}  // namespace hamjet::io
