#include "hamjet/detail/dynamics/operation_list.hpp"

#include <algorithm>
#include <utility>

#include "hamjet/error.hpp"

namespace hamjet {

OperationList::OperationList(std::size_t inputs, std::vector<Operation> operations,
                             std::vector<std::size_t> outputs)
    : inputs_(inputs), operations_(std::move(operations)), outputs_(std::move(outputs)) {
  if (inputs > 64) throw Error(ErrorKind::usage, "operation list: more than 64 inputs");
  for (const Operation& o : operations_) {
    std::uint64_t mask = 0;
    bool affine = true;
    switch (o.code) {
      case OperationCode::input:
        mask = std::uint64_t{1} << o.u;
        break;
      case OperationCode::linear:
        for (const LinearTerm& term : o.terms) {
          mask |= dependencies_[term.value];
          affine = affine && affine_[term.value];
        }
        break;
      case OperationCode::product:
      case OperationCode::quotient:
      case OperationCode::angle:
        mask = dependencies_[o.u] | dependencies_[o.v];
        affine = false;
        break;
      default:
        mask = dependencies_[o.u];
        affine = false;
    }
    dependencies_.push_back(mask);
    affine_.push_back(affine);
  }
}

bool OperationList::is_linear_system() const {
  return std::all_of(outputs_.begin(), outputs_.end(), [&](std::size_t o) { return affine_[o]; });
}

std::size_t OperationList::nonlinear_operations() const {
  return static_cast<std::size_t>(
      std::count_if(operations_.begin(), operations_.end(), [](const Operation& o) {
        return o.code != OperationCode::input && o.code != OperationCode::linear;
      }));
}

}  // namespace hamjet
