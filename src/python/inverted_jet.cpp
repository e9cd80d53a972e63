#include "inverted_jet.hpp"

#include <span>
#include <utility>

#include "hamjet/algebra/calculus.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"

namespace hamjet::python {
namespace {

GeneratingFunctionKind chosen_kind(const io::StoredJet& stored, std::string_view kind) {
  if (stored.parameters > 0) {
    throw Error(ErrorKind::usage,
                "partial inversion: the jet is expanded in parameters or ends with them, must be "
                "one of positions and momenta alone, whose map has as many chosen variables as "
                "remaining ones");
  }
  if (stored.variables != stored.components) {
    throw Error(ErrorKind::usage,
                "partial inversion: the jet must be expanded in all of its components");
  }
  return kind == "auto" ? best_conditioned_kind<Extended>(stored.jet, stored.momentum_exponent())
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

InvertedJet::Parts solve(const Jet& jet, std::string_view requested) {
  const io::StoredJet& stored = jet.stored();
  const GeneratingFunctionKind kind = chosen_kind(stored, requested);
  const auto inversion = invert_partially<Extended>(stored.jet, kind, rounding_of(stored.precision),
                                                    stored.momentum_exponent());
  const auto sigma = one_form(inversion);
  const Series<Extended> function = generating_function(sigma);
  std::vector<Series<Extended>> gradient;
  for (std::size_t i = 0; i < function.space().variables(); ++i) {
    gradient.push_back(derivative(function, i));
  }
  std::vector<Series<Extended>> remaining = inversion.remaining_final;
  remaining.insert(remaining.end(), inversion.remaining_initial.begin(),
                   inversion.remaining_initial.end());
  return {kind,
          inversion.condition,
          names(stored, kind, true),
          names(stored, kind, false),
          {convert_series<double>(function)},
          convert_map<double>(gradient),
          convert_map<double>(remaining),
          exactness_residual(sigma)};
}

}  // namespace

InvertedJet::InvertedJet(const Jet& jet, std::string_view kind) : InvertedJet(solve(jet, kind)) {}

InvertedJet::InvertedJet(Parts parts) : parts_(std::move(parts)) {
  evaluators_.emplace_back(parts_.function);
  // The gradient has one degree less than the function, whose space it is in.
  evaluators_.emplace_back(parts_.gradient, space()->order() - 1);
  evaluators_.emplace_back(parts_.remaining);
}

}  // namespace hamjet::python
