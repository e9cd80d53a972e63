#include "hamjet/detail/dynamics/operation_list.hpp"

#include <algorithm>
#include <utility>

#include "hamjet/error.hpp"

namespace hamjet {

OperationList::OperationList(std::size_t inputs, std::vector<Operation> operations,
                             std::vector<std::size_t> outputs, bool has_time)
    : inputs_(inputs),
      has_time_(has_time),
      operations_(std::move(operations)),
      outputs_(std::move(outputs)) {
  if (inputs > 64) throw Error(ErrorKind::usage, "operation list: more than 64 inputs");
  for (std::size_t i = 0; i < operations_.size(); ++i) set_properties(i);
  first_series_value_ = inputs_;
  while (first_series_value_ < operations_.size() && is_number(first_series_value_)) {
    ++first_series_value_;
  }
}

void OperationList::set_properties(std::size_t value) {
  Operation& o = operations_[value];
  std::uint64_t mask = 0;
  bool has_time = false;
  bool is_affine = true;
  bool has_sums = false;
  if (o.code == OperationCode::input) {
    has_time = has_time_ && o.u + 1 == inputs_;
    if (!has_time) mask = std::uint64_t{1} << o.u;
  } else {
    for_each_operand(o, [&](std::size_t operand) {
      mask |= dependencies_[operand];
      has_time = has_time || depends_on_time_[operand];
      is_affine = is_affine && affine_[operand];
    });
  }
  switch (o.code) {
    case OperationCode::input:
      break;
    case OperationCode::linear:
      std::stable_partition(o.terms.begin(), o.terms.end(),
                            [this](const LinearTerm& term) { return !is_number(term.value); });
      break;
    case OperationCode::product:
      if (is_number(o.u)) std::swap(o.u, o.v);
      has_sums = !is_number(o.v);
      break;
    case OperationCode::field:
      is_affine = false;
      has_sums = !o.products.empty();
      break;
    default:
      has_sums = true;
  }
  const bool is_of_numbers = mask == 0;
  dependencies_.push_back(mask);
  depends_on_time_.push_back(has_time);
  has_sums_.push_back(has_sums && !is_of_numbers);
  affine_.push_back(is_of_numbers || (is_affine && !has_sums));
}

bool OperationList::is_linear_system() const {
  return std::all_of(outputs_.begin(), outputs_.end(), [&](std::size_t o) { return affine_[o]; });
}

bool OperationList::depends_on_time() const {
  return std::any_of(outputs_.begin(), outputs_.end(),
                     [&](std::size_t o) { return depends_on_time_[o]; });
}

bool OperationList::has_fields() const {
  return std::any_of(operations_.begin(), operations_.end(),
                     [](const Operation& o) { return o.code == OperationCode::field; });
}

std::size_t OperationList::nonlinear_operations() const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < operations_.size(); ++i) {
    if (has_sums(i) || operations_[i].code == OperationCode::field) ++count;
  }
  return count;
}

OperationList needed_operations(std::size_t inputs, std::vector<Operation> operations,
                                std::vector<std::size_t> outputs, bool has_time) {
  const std::size_t size = operations.size();
  std::vector<bool> is_needed(size, false);
  for (std::size_t i = 0; i < inputs; ++i) is_needed[i] = true;
  for (const std::size_t output : outputs) is_needed[output] = true;
  // A cosine follows its sine, so that the sine is looked at after it.
  for (std::size_t i = size; i-- > inputs;) {
    if (!is_needed[i]) continue;
    for_each_operand(operations[i], [&](std::size_t operand) { is_needed[operand] = true; });
    if (is_of_pair(operations[i].code)) is_needed[operations[i].v] = true;
  }
  std::vector<bool> is_number(size, false);
  for (std::size_t i = 0; i < size; ++i) {
    const Operation& o = operations[i];
    is_number[i] = o.code != OperationCode::input || (has_time && o.u + 1 == inputs);
    for_each_operand(
        o, [&](std::size_t operand) { is_number[i] = is_number[i] && is_number[operand]; });
  }
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < inputs; ++i) order.push_back(i);
  for (const bool wanted : {true, false}) {
    for (std::size_t i = inputs; i < size; ++i) {
      if (is_needed[i] && is_number[i] == wanted) order.push_back(i);
    }
  }
  std::vector<std::size_t> place(size, 0);
  for (std::size_t k = 0; k < order.size(); ++k) place[order[k]] = k;
  std::vector<Operation> kept;
  for (const std::size_t i : order) {
    Operation& o = kept.emplace_back(std::move(operations[i]));
    if (o.code == OperationCode::input) continue;
    o.u = place[o.u];
    o.v = place[o.v];
    for (LinearTerm& term : o.terms) term.value = place[term.value];
    for (FieldProduct& product : o.products) product.factor = place[product.factor];
    for (FieldPart& part : o.parts) {
      for (std::size_t& value : part.position) value = place[value];
    }
  }
  for (std::size_t& output : outputs) output = place[output];
  return {inputs, std::move(kept), std::move(outputs), has_time};
}

}  // namespace hamjet
