#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "../app/processors.hpp"
#include "../app/scene_refusal.hpp"
#include "../studies/many_flows.hpp"
#include "arrays.hpp"
#include "bindings.hpp"
#include "given_scene.hpp"
#include "interruptible.hpp"
#include "jet.hpp"

namespace hamjet::python {
namespace {

using Rows = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Orbits that were integrated side by side; the package makes a ManyJets of it.
class ManyStudy {
 public:
  explicit ManyStudy(ManyFlows flows)
      : flows_(std::make_shared<const ManyFlows>(std::move(flows))) {}

  std::string label() const { return flows_->settings.label; }
  double duration_s() const { return flows_->scene.duration * flows_->scene.units.time_s; }

  /// (orbits, components, coefficients); NaN where an orbit has failed.
  py::array_t<double> coefficients() const {
    const ComputedProblem& problem = flows_->problem;
    const std::size_t components = problem.components.size();
    std::vector<double> numbers;
    numbers.reserve(flows_->outcomes.size() * components * problem.space->size());
    for (const ManyFlowsOutcome& outcome : flows_->outcomes) {
      if (outcome.jet.empty()) {
        numbers.insert(numbers.end(), components * problem.space->size(), none);
      }
      for (const Series<double>& component : outcome.jet) {
        numbers.insert(numbers.end(), component.coefficients().begin(),
                       component.coefficients().end());
      }
    }
    return array_of(std::move(numbers), {size_of(flows_->outcomes.size()), size_of(components),
                                         size_of(problem.space->size())});
  }

  py::array_t<unsigned char> exponents() const {
    const SeriesSpace& space = *flows_->problem.space;
    std::vector<unsigned char> numbers;
    for (std::size_t k = 0; k < space.size(); ++k) {
      const auto exponents = space.exponents(k);
      numbers.insert(numbers.end(), exponents.begin(), exponents.end());
    }
    return array_of(std::move(numbers), {size_of(space.size()), size_of(space.variables())});
  }

  py::array_t<long> steps() const {
    std::vector<long> numbers;
    for (const ManyFlowsOutcome& outcome : flows_->outcomes) {
      numbers.push_back(outcome.statistics.steps);
    }
    return array_of(std::move(numbers));
  }
  py::object were_alone() const {
    std::vector<bool> values;
    for (const ManyFlowsOutcome& outcome : flows_->outcomes) values.push_back(outcome.was_alone);
    return flags(values);
  }
  /// Texts by orbit.
  py::dict failures() const {
    py::dict result;
    for (std::size_t i = 0; i < flows_->outcomes.size(); ++i) {
      const auto& failure = flows_->outcomes[i].failure;
      if (failure) result[py::int_(i)] = std::string(failure->what());
    }
    return result;
  }

  Jet jet(std::size_t orbit) const {
    const ManyFlowsOutcome& outcome = flows_->outcomes.at(orbit);
    if (outcome.failure) throw Error(*outcome.failure);
    const PropagationResult result = flows_->result_of(orbit);
    return jet_of(result, result.runs[0]);
  }

 private:
  std::shared_ptr<const ManyFlows> flows_;
};

ManyStudy integrate_many(const GivenScene& given, const std::string& run, const Rows& states,
                         bool is_in_km, std::optional<std::size_t> threads,
                         const py::object& progress) {
  const Scene scene = given.flow_jet(io::SceneUnits::told);
  const std::size_t count = threads ? *threads : cli::usable_processors();
  std::vector<std::vector<double>> rows;
  const auto width = static_cast<std::size_t>(states.shape(1));
  for (py::ssize_t i = 0; i < states.shape(0); ++i) {
    const double* const row = states.data(i, 0);
    rows.emplace_back(row, row + width);
  }
  return interruptibly(progress, [scene, file = given.file, run, rows = std::move(rows), is_in_km,
                                  count](const ProgressCallback& report) {
    return ManyStudy(cli::study_of(
        file, [&] { return study_many_flows(scene, run, rows, is_in_km, count, report); }));
  });
}

}  // namespace

void bind_many(py::module_& module) {
  py::class_<ManyStudy>(module, "ManyStudy")
      .def_property_readonly("label", &ManyStudy::label)
      .def_property_readonly("duration_s", &ManyStudy::duration_s)
      .def_property_readonly("steps", &ManyStudy::steps)
      .def_property_readonly("were_alone", &ManyStudy::were_alone)
      .def_property_readonly("failures", &ManyStudy::failures)
      .def("coefficients", &ManyStudy::coefficients)
      .def("exponents", &ManyStudy::exponents)
      .def("jet", &ManyStudy::jet, py::arg("orbit"));
  module.def("integrate_many", &integrate_many, py::arg("scene"), py::arg("run"), py::arg("states"),
             py::arg("is_in_km"), py::arg("threads"), py::arg("progress"));
}

}  // namespace hamjet::python
