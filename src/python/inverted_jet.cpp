#include "inverted_jet.hpp"

#include <span>

#include "hamjet/algebra/calculus.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"

namespace hamjet::python {
namespace {

using JetSpan = std::span<const Series<Extended>>;

GeneratingFunctionKind chosen_kind(const io::StoredJet& stored, std::string_view kind) {
  if (stored.variables != stored.components) {
    throw Error(ErrorKind::usage,
                "partial inversion: the jet must be expanded in all of its components");
  }
  return kind == "auto" ? best_conditioned_kind<Extended>(JetSpan(stored.jet))
                        : parse_kind(kind, stored.components.size() / 2);
}

std::vector<std::string> names(const io::StoredJet& stored, const GeneratingFunctionKind& kind,
                               bool chosen) {
  const auto of_model = stored.variable_names();
  std::vector<std::string> result;
  for (std::size_t i = 0; i < kind.degrees_of_freedom(); ++i) {
    result.emplace_back(of_model[stored.components[kind.final_variable(i, chosen)]]);
  }
  for (std::size_t i = 0; i < kind.degrees_of_freedom(); ++i) {
    result.emplace_back(std::string(of_model[stored.components[kind.initial_variable(i, chosen)]]) +
                        "0");
  }
  return result;
}

}  // namespace

InvertedJet::InvertedJet(const Jet& jet, std::string_view kind)
    : kind_(chosen_kind(jet.stored(), kind)),
      variables_(names(jet.stored(), kind_, true)),
      remaining_names_(names(jet.stored(), kind_, false)) {
  const io::StoredJet& stored = jet.stored();
  const auto inversion =
      invert_partially<Extended>(JetSpan(stored.jet), kind_, rounding_of(stored.precision));
  condition_ = inversion.condition;
  const auto sigma = one_form(inversion);
  exactness_ = exactness_residual(sigma);
  const Series<Extended> function = generating_function(sigma);
  space_ = function.space_pointer();
  const Series<double> rounded = convert_series<double>(function);
  coefficients_.assign(rounded.coefficients().begin(), rounded.coefficients().end());

  std::vector<Series<Extended>> gradient;
  for (std::size_t i = 0; i < space_->variables(); ++i) gradient.push_back(derivative(function, i));
  std::vector<Series<Extended>> remaining = inversion.remaining_final;
  remaining.insert(remaining.end(), inversion.remaining_initial.begin(),
                   inversion.remaining_initial.end());
  evaluators_.emplace_back(std::span<const Series<double>>(&rounded, 1));
  evaluators_.emplace_back(convert_map<double>(gradient), stored.order());
  evaluators_.emplace_back(convert_map<double>(remaining));
}

}  // namespace hamjet::python
