#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "hamjet/store/output_directory.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet::io {

/// `summary.json`: scene, units, reference, and for every run its statistics, checks, residuals
/// with their rounding floors, symplecticity and errors. What was not computed is null.
std::string summary_json(const PropagationResult& result);

/// `<label>/jet.csv`: one row a coefficient, the row with exponents 0 being the nominal's final
/// state. 17 digits, or 36 in extended precision; canonical units.
std::string jet_csv(const PropagationResult& result, const RunResult& run);

/// `<label>/generating_function_<kind>.csv`: exponents of the 2n variables it takes (final ones,
/// then initial ones with a 0 behind the name) and coefficient.
std::string generating_function_csv(const PropagationResult& result, const KindResult& kind);

/// `<label>/nominal.csv`: time (canonical and s), state (canonical), relative energy error.
std::string nominal_csv(const PropagationResult& result, const RunResult& run);

/// `relative_hamiltonian.csv`: time, exponents, coefficient.
std::string relative_hamiltonian_csv(const PropagationResult& result);

/// `<label>/along_time.csv`, if the scene asks for a figure: time (canonical and s), exactness
/// residual of degree 0 of the figure's kind (scaled; empty where the kind does not exist) with the
/// condition of its linear part, relative energy error. A row whose residual is "singular" stands
/// where the kind ceases to exist.
std::string along_time_csv(const PropagationResult& result, const RunResult& run);

/// `figure.svg`, drawn by gnuplot; empty if the scene asks for none, or with the reason in
/// `problem`, one line, if it cannot be drawn.
std::string figure_svg(const PropagationResult& result, std::optional<std::string>& problem);

/// Writes all files above to a directory. Returns the summary as it is there, with the checksums of
/// the files. Throws Error(input_output).
std::string write_results(const PropagationResult& result, const std::string& figure,
                          OutputDirectory& output);

/// The table for the terminal: time, error and a verdict of every integrator, and the reasons.
std::string summary_table(const PropagationResult& result);

/// What the terminal shows beside it if asked for more: steps, further errors, exactness.
std::string summary_details(const PropagationResult& result);

/// One line that says into how many arcs a run is split, why, and what that is expected to bring.
std::string arcs_text(const Scene& scene, const ArcPlan& plan);

}  // namespace hamjet::io
