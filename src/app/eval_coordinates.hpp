#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "argument_words.hpp"
#include "hamjet/formats/stored_jet.hpp"
#include "hamjet/relative_motion/deputy_coordinates.hpp"
#include "jet_evaluation.hpp"

namespace hamjet::cli {

/// The word for canonical deviations.
inline constexpr std::string_view canonical_frame = "canonical";

/// The forms of deputies that have words of their own.
const std::vector<DeputyForm>& forms();

/// The words of the command line, or of the module's evaluate_relative.
struct EvalFrames {
  std::string frame = "RTN";           ///< name of a form, or canonical
  std::optional<std::string> to = {};  ///< the frame of the results; that of `frame` if absent
  /// Velocities in RTN: rotating (default) or inertial.
  std::optional<std::string> derivatives = {};
  Caller caller = Caller::command;

  const std::string& final_frame() const { return to ? *to : frame; }
  /// Throws Error(usage) if they are no such words or do not fit each other.
  void check() const;
};

/// The numbers in which the user gives deviations from a jet's nominal and wants the final ones:
/// canonical, or a relative state of an orbit in metres and m/s.
class EvalCoordinates {
 public:
  /// `told` takes the jet's canonical numbers into those that the user gives and wants. Throws
  /// Error(usage) if the words are wrong or do not fit the jet's model, and Error(numerical) as
  /// DeputyCoordinates.
  EvalCoordinates(const io::StoredJet& stored, const EvalFrames& frames,
                  const CanonicalFactors& told = {});

  /// The frame in words, with the derivatives.
  const std::string& text() const { return text_; }
  /// Names of the columns of a deviation, and of a final state.
  const std::vector<std::string_view>& initial_columns() const { return initial_columns_; }
  const std::vector<std::string_view>& final_columns() const { return final_columns_; }

  /// A canonical deviation (dq, dp) of the jet in the numbers of the initial columns.
  std::vector<double> initial_row(std::span<const double> canonical) const;
  /// The jet's variables of a deviation. Throws Error(usage) if the deviation has other components
  /// too, of which the jet says nothing, or is none of a deputy.
  std::vector<double> variables(std::span<const double> deviation) const;
  /// The final state of the jet's components. The miss is made larger by what the chief's error,
  /// canonical, turns the axes by. Where the state has not what the form needs it is NaN, and not
  /// inside.
  std::vector<double> final_state(std::span<const double> components, double chief_error,
                                  MissEstimate& miss) const;

 private:
  /// By how much a final position turns with its axes, in metres, where they are the chief's.
  double turned_m(std::span<const double> components, double chief_error) const;
  /// By what a component of the state is multiplied to be told.
  double told_factor(std::size_t component) const;

  const io::StoredJet& stored_;
  CanonicalFactors told_;
  std::vector<std::string_view> initial_columns_;
  std::vector<std::string_view> final_columns_;
  std::string text_ = "canonical";
  std::optional<DeputyCoordinates> initial_;  ///< absent: canonical
  std::optional<DeputyCoordinates> final_;
  bool has_axes_of_chief_ = false;  ///< the final numbers, of positions
  double chief_distance_ = 0;       ///< from the centre at the end, of an orbit
};

}  // namespace hamjet::cli
