#include "clp_solver.hpp"

#include <Clp_C_Interface.h>
#include <fmt/format.h>

#include <CoinError.hpp>
#include <string>
#include <string_view>

#include "least_impulses.hpp"

namespace hamjet {

struct LinearProgram::Model {
  Model() : clp(Clp_newModel()) {}
  ~Model() { Clp_deleteModel(clp); }
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  Clp_Simplex* clp;
};

LinearProgram::LinearProgram(const std::vector<Row>& rows) : model_(std::make_unique<Model>()) {
  constexpr double tolerance = 1e-10;  // for rows and columns that are of order one
  Clp_Simplex* const clp = model_->clp;
  Clp_setLogLevel(clp, 0);
  // Clp's own scaling would take rounding errors among the coefficients for small numbers, and
  // magnify them.
  Clp_scaling(clp, 0);
  Clp_setPrimalTolerance(clp, tolerance);
  Clp_setDualTolerance(clp, tolerance);
  std::vector<double> lower;
  std::vector<double> upper;
  for (const Row& row : rows) {
    lower.push_back(row.lower);
    upper.push_back(row.upper);
  }
  const std::vector<CoinBigIndex> starts(rows.size() + 1, 0);
  Clp_addRows(clp, static_cast<int>(rows.size()), lower.data(), upper.data(), starts.data(),
              nullptr, nullptr);
}

LinearProgram::~LinearProgram() = default;

void LinearProgram::add(const std::vector<Column>& columns) {
  const std::vector<double> least(columns.size(), 0);
  std::vector<double> most;
  std::vector<double> costs;
  std::vector<CoinBigIndex> starts = {0};
  std::vector<int> rows;
  std::vector<double> values;
  for (const Column& column : columns) {
    most.push_back(column.most);
    costs.push_back(column.cost);
    for (const Entry& entry : column.entries) {
      rows.push_back(static_cast<int>(entry.row));
      values.push_back(entry.value);
    }
    starts.push_back(static_cast<CoinBigIndex>(rows.size()));
  }
  Clp_addColumns(model_->clp, static_cast<int>(columns.size()), least.data(), most.data(),
                 costs.data(), starts.data(), rows.data(), values.data());
}

void LinearProgram::set_costs(const std::vector<double>& costs) {
  Clp_chgObjCoefficients(model_->clp, costs.data());
}

void LinearProgram::fix(std::size_t column, double value) {
  Clp_Simplex* const clp = model_->clp;
  const auto count = static_cast<std::size_t>(Clp_numberColumns(clp));
  std::vector<double> lower(Clp_columnLower(clp), Clp_columnLower(clp) + count);
  std::vector<double> upper(Clp_columnUpper(clp), Clp_columnUpper(clp) + count);
  lower[column] = upper[column] = value;
  Clp_chgColumnLower(clp, lower.data());
  Clp_chgColumnUpper(clp, upper.data());
}

void LinearProgram::solve() {
  std::string reason;
  try {
    Clp_primal(model_->clp, 0);
    constexpr std::string_view reasons[] = {"", "it has no solution", "it has no bound",
                                            "it took too many steps", "it lost its precision"};
    const int status = Clp_status(model_->clp);
    if (status == 0 && Clp_secondaryStatus(model_->clp) == 0) return;
    reason = status > 0 && status < 5 ? reasons[status] : "it was stopped";
  } catch (const CoinError& error) {
    reason = error.message();
  }
  throw UnprovedLeast(
      fmt::format("the simplex method found no optimum of a linear program: {}", reason));
}

std::span<const double> LinearProgram::values() const {
  return {Clp_primalColumnSolution(model_->clp),
          static_cast<std::size_t>(Clp_numberColumns(model_->clp))};
}

std::span<const double> LinearProgram::duals() const {
  return {Clp_dualRowSolution(model_->clp), static_cast<std::size_t>(Clp_numberRows(model_->clp))};
}

}  // namespace hamjet
