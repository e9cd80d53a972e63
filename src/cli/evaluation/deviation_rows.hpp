#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "../../app/eval_coordinates.hpp"
#include "../../formats/number_table.hpp"
#include "../../store/input_stream.hpp"
#include "eval_command.hpp"
#include "hamjet/formats/stored_jet.hpp"

namespace hamjet::cli {

/// The deviations that the options name, part by part: one row, the deputy of a scene, or a file,
/// a pipe or standard input of any length. `options` and `coordinates` outlive it.
class DeviationRows {
 public:
  /// Throws Error(usage) or Error(scene) for a row or a deputy that cannot be evaluated, and as
  /// io::InputStream.
  DeviationRows(const EvalOptions& options, const io::StoredJet& stored,
                const EvalCoordinates& coordinates);
  DeviationRows(const DeviationRows&) = delete;
  DeviationRows& operator=(const DeviationRows&) = delete;

  /// Makes sure that the rows can be read several times.
  void keep();
  /// Begins with the first row.
  void rewind();
  /// The next rows, at most so many; none at the end. Throws as io::NumberTableReader.
  io::NumberTable read(std::size_t most_rows);

  /// The jet's variables of a row; an error says where the row stands that has none.
  std::vector<double> variables(const EvalCoordinates& coordinates, const io::NumberTable& part,
                                std::size_t row) const;

 private:
  const EvalOptions& options_;
  const EvalCoordinates& coordinates_;
  std::optional<io::InputStream> input_;
  std::optional<io::NumberTableReader> reader_;  ///< the reader of the input
  io::NumberTable row_;                          ///< the only one, without an input
  std::vector<double> parameters_;               ///< of the deputy, behind positions and momenta
  bool is_at_end_ = false;
};

}  // namespace hamjet::cli
