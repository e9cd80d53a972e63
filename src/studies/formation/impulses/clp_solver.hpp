#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace hamjet {

/// A linear program: least cost . x with lower <= A x <= upper and 0 <= x <= most. Columns can be
/// added. It is solved by the primal simplex method of COIN-OR's Clp, starting from the last basis.
class LinearProgram {
 public:
  struct Row {
    double lower = 0;
    double upper = 0;
  };
  struct Entry {
    std::size_t row = 0;
    double value = 0;
  };
  struct Column {
    double cost = 0;
    double most = std::numeric_limits<double>::max();  // the solver's infinity
    std::vector<Entry> entries;
  };

  explicit LinearProgram(const std::vector<Row>& rows);
  ~LinearProgram();
  LinearProgram(const LinearProgram&) = delete;
  LinearProgram& operator=(const LinearProgram&) = delete;

  void add(const std::vector<Column>& columns);
  /// Gives each column a new cost.
  void set_costs(const std::vector<double>& costs);
  /// Restricts a column's variable to one value.
  void fix(std::size_t column, double value);

  /// Throws UnprovedLeast unless the solver reports that it found the optimum.
  void solve();
  /// Results of the last solve(): the value of each column, and the multiplier of each row.
  std::span<const double> values() const;
  std::span<const double> duals() const;

 private:
  struct Model;  // keeps the solver's header out of this header
  std::unique_ptr<Model> model_;
};

}  // namespace hamjet
