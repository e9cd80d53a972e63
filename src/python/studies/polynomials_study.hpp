#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "../../app/deputy_evaluation.hpp"

namespace hamjet::python {

/// The polynomials of a scene in its coordinates, or stored ones; the package makes a Polynomials
/// of it.
class PolynomialsStudy {
 public:
  PolynomialsStudy(Scene scene, std::string file);
  explicit PolynomialsStudy(cli::EvaluatedScene evaluated)
      : evaluated_(std::make_shared<const cli::EvaluatedScene>(std::move(evaluated))) {}

  std::string scene() const { return evaluated_->chief.scene; }
  std::string run() const { return evaluated_->chief.label; }
  int order() const { return evaluated_->flow->order(); }
  std::size_t variables() const { return evaluated_->flow->variables(); }
  std::string coordinates() const { return std::string(name_of(evaluated_->coordinates.start)); }
  std::string end_coordinates() const { return std::string(name_of(evaluated_->coordinates.end)); }
  double duration_s() const { return evaluated_->chief.duration * evaluated_->chief.units.time_s; }
  const cli::EvaluatedScene& evaluated() const { return *evaluated_; }

  pybind11::object evaluate_relative(const pybind11::object& states, const std::string& frame,
                                     const std::optional<std::string>& to,
                                     const std::optional<std::string>& derivatives,
                                     std::optional<int> degree, bool is_strict) const;

  /// Proved reaches at the end of the duration, by order, in metres.
  pybind11::array_t<double> reach(double tolerance_m, int samples,
                                  const pybind11::object& progress) const;

 private:
  std::optional<Scene> scene_;  ///< none of stored ones
  std::string file_;
  std::shared_ptr<const cli::EvaluatedScene> evaluated_;
};

}  // namespace hamjet::python
