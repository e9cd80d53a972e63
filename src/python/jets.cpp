#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "../text/quantity_text.hpp"
#include "arithmetic_scope.hpp"
#include "bindings.hpp"
#include "by_degree.hpp"
#include "evaluation.hpp"
#include "hamjet/error.hpp"
#include "hamjet/maps/truncation_estimate.hpp"
#include "interruptible.hpp"
#include "inverted_jet.hpp"
#include "jet.hpp"
#include "jet_arrays.hpp"
#include "jet_files.hpp"
#include "pickling.hpp"
#include "refusal.hpp"
#include "relative_rows.hpp"
#include "signature.hpp"

namespace hamjet::python {
namespace {

using JetPointer = std::shared_ptr<Jet>;

constexpr const char* jet_doc =
    R"(A Taylor polynomial of the flow about a nominal trajectory; immutable.

Everything is in canonical units (see `units`) unless its name says otherwise. Of a jet of the order
N in v variables with c components and k = C(v + N, N) coefficients a component:

  coefficients   (c, k) float64: column 0 is the nominal's final state
  exponents      (k, v) uint8: of the initial deviations, graded as 1, x, y, x^2, xy, y^2

so that component i of the final state is sum_k coefficients[i, k] prod_j d[j]**exponents[k, j]
for the initial deviations d. Both are read-only views of the jet's own memory. Coefficients of a
jet in extended precision are rounded here; what is computed from the jet uses all digits.)";

constexpr const char* evaluate_doc =
    R"(Final deviations from the nominal for initial ones, both canonical.

deviations: array (N, variables), or (variables,) for one. An aligned float64 array in C order is
read where it is; anything else is converted first, which takes a copy. The columns of a data frame,
and a row of one, are taken by name, whatever their order: the jet's variables.
out: None, or a writable float64 array in C order of the result's shape, which may be `deviations`
itself if the jet has as many components as variables.
degree: leaves out the terms above it.

Returns an array (N, components), or (components,). The nominal's final state, nominal_final, is
not added, for small deviations would lose their digits in it. Rows that are not finite, or
overflow, stay alone and give a RuntimeWarning. Other threads run meanwhile. Raises UsageError.)";

constexpr const char* jacobian_doc =
    R"(Derivatives of the final deviations by the initial ones, at initial ones; canonical.

deviations: as of evaluate. Returns an array (N, components, variables), or (components,
variables) of one: the state transition matrix about the trajectory that starts there. At zero it
is linear_part. A call for many points prepares the derivatives once. Raises UsageError.)";

constexpr const char* evaluate_relative_doc =
    R"(Carries relative states through the jet of an orbit, as `hamjet eval` does.

states: (N, 6) or (6,), the deputy relative to the chief at the start: position in m and velocity in
m/s along the axes of the frame, or six numbers of another form; columns of a data frame by name, as
the columns of a file of `hamjet eval`. frame: "RTN" (radial, transverse, normal of the chief),
"inertial", "curvilinear", "relative-elements" or "element-differences" (`hamjet eval --help` has
the numbers of each). to: likewise, of the results; by default as frame. derivatives: of RTN,
"rotating" (default: velocities as seen from the turning axes) or "inertial". degree: leaves out
the terms above it. strict: raises NumericalError if a row is not inside the polynomial's reach;
otherwise such rows give a RuntimeWarning.

Returns a RelativeStates: the states at the end of the duration, (N, 6), with an estimate of the
miss of each; NaN where the final state has no elements. The conversions make it several times
slower than evaluate, and those of elements a thousand times. Raises UsageError.)";

constexpr const char* compose_doc =
    R"(The jet of this flow and then that of `after`, of the lower of their orders.

`after` must be of the same system in the same units, expanded in this jet's components, and start
where this one ends (to 1e-12), and if both are dated, when it does and in the same frame.
`after @ jet` is the same. Raises UsageError.)";

constexpr const char* matmul_doc =
    R"(The jet of the flow of `before` and then of this one: before.compose(self).

It is written as the product of their linear parts is. jet.inverse() @ jet is the identity but for
what rounding leaves, see `inverse`.)";

constexpr const char* inverse_doc =
    R"(The jet of the flow back: from deviations at the end to those at the start.

The jet must be expanded in all of its components. Rounding comes back multiplied by the
condition number of the linear part, c = numpy.linalg.cond(jet.linear_part), once for each degree:
for a deviation of size r at the end, canonical, the terms of degree d are wrong by about
1e-16 (c r)^d. c grows along a flow, and (jet.inverse() @ jet)(x) - x shows what is left. Raises UsageError, NumericalError where the linear
part is singular.)";

constexpr const char* invert_partially_doc =
    R"(The generating function of a kind, with the map solved for the variables it does not take.

kind: "F1" to "F4", letters such as "qpq-qqp" (final variables, then initial ones), or "auto", the
best conditioned. Computed in extended precision, as the command does: order 4 takes some 50 ms,
order 6 a second, order 8 half a minute. Raises NumericalError where the kind does not exist,
UsageError.)";

constexpr const char* symplecticity_doc =
    R"(Defects of the Poisson brackets, degree by degree: is this the jet of a symplectic map?

Returns a structured array with the fields degree (0 to N-1), absolute, and scaled: the largest
coefficient of {z_i, z_j} - J_ij, divided by the largest sum of absolute values that cancel in one.
The jet must be expanded in all variables of phase space. Raises UsageError.)";

std::vector<std::string> names(const io::StoredJet& stored,
                               const std::vector<std::size_t>& indices) {
  const auto all = stored.variable_names();
  std::vector<std::string> result;
  for (const std::size_t i : indices) result.emplace_back(all[i]);
  return result;
}

py::array_t<double> linear_part(const Jet& jet) {
  const auto coefficients = jet.coefficients();
  const std::size_t components = jet.stored().components.size();
  const std::size_t variables = jet.stored().variables.size();
  std::vector<double> numbers;
  for (std::size_t c = 0; c < components; ++c) {
    const auto row = coefficients.subspan(c * jet.space()->size() + 1, variables);
    numbers.insert(numbers.end(), row.begin(), row.end());
  }
  return array_of(std::move(numbers), {size_of(components), size_of(variables)});
}

py::object evaluate(const Jet& jet, const py::object& deviations, const py::object& out,
                    std::optional<int> degree) {
  const auto columns = [&] { return names(jet.stored(), jet.stored().variables); };
  if (!degree) return evaluate_array(jet.deviation(), deviations, columns, out, "deviations");
  return evaluate_array(jet.deviation_to(*degree), deviations, columns, out, "deviations");
}

py::object jacobian(const Jet& jet, const py::object& deviations) {
  const auto columns = [&] { return names(jet.stored(), jet.stored().variables); };
  const py::object rows =
      evaluate_array(jet.derivatives(), deviations, columns, py::none(), "deviations");
  std::vector<py::ssize_t> shape;
  if (py::cast<py::array>(rows).ndim() == 2) shape.push_back(py::cast<py::array>(rows).shape(0));
  shape.push_back(size_of(jet.stored().components.size()));
  shape.push_back(size_of(jet.stored().variables.size()));
  return rows.attr("reshape")(shape);
}

Jet composition(const JetPointer& first, const JetPointer& second) {
  return interruptibly(py::none(), [first, second](const ProgressCallback&) {
    return first->composed_with(*second);
  });
}

py::object evaluate_relative_states(const Jet& jet, const py::object& states,
                                    const std::string& frame, const std::optional<std::string>& to,
                                    const std::optional<std::string>& derivatives,
                                    std::optional<int> degree, bool is_strict) {
  if (degree) jet.deviation_to(*degree);  // refuses what is out of range
  return relative_states(jet.stored(), jet.stored(), states,
                         {{frame, to, derivatives, cli::Caller::module}, degree}, is_strict);
}

std::string representation(const Jet& jet) {
  const io::StoredJet& stored = jet.stored();
  std::string variables;
  const auto all = stored.variable_names();
  for (const std::size_t v : stored.variables)
    variables += (variables.empty() ? "" : ", ") + std::string(all[v]);
  return "<hamjet.Jet of order " + std::to_string(stored.order()) + " in " + variables + ": " +
         stored.scene + ", " + stored.label + ">";
}

/// Canonical units of these lengths and times. Throws Error(usage) unless both are above 0.
CanonicalUnits units_of(double length_km, double time_s) {
  for (const auto& [name, value] : {std::pair("length_km", length_km), {"time_s", time_s}}) {
    if (!std::isnormal(value) || value < 0) {
      refuse(fmt::format("Units: {}: got {}, must be a number above 0", name, value));
    }
  }
  return {length_km, time_s};
}

void bind_units(py::module_& module) {
  py::class_<CanonicalUnits> units(
      module, "Units",
      "Canonical units: an SI value is the canonical one times these. For an orbit mu = 1.");
  bind_copies(units);
  units
      .def(py::init(&units_of), py::arg("length_km"), py::arg("time_s"),
           documented("__init__(self, length_km, time_s)",
                      "Units of these sizes; for an orbit mu is 1 only where time_s is "
                      "sqrt(length_km^3 / mu).")
               .c_str())
      .def_property_readonly(
          "length_km", [](const CanonicalUnits& u) { return u.length_km; },
          "Kilometres in a unit of length.")
      .def_property_readonly(
          "time_s", [](const CanonicalUnits& u) { return u.time_s; }, "Seconds in a unit of time.")
      .def_property_readonly(
          "velocity_km_s", [](const CanonicalUnits& u) { return u.length_km / u.time_s; },
          "Kilometres a second in a unit of velocity.")
      .def("__repr__", [](const CanonicalUnits& u) {
        return py::str("Units(length_km={!r}, time_s={!r})").format(u.length_km, u.time_s);
      });
}

void bind_description(py::class_<Jet, JetPointer>& jet) {
  const auto keep = [](py::object self) { return self.cast<JetPointer>(); };
  jet.def_property_readonly(
         "scene", [](const Jet& j) { return j.stored().scene; }, "Name of the scene.")
      .def_property_readonly(
          "run", [](const Jet& j) { return j.stored().label; }, "Label of the run.")
      .def_property_readonly(
          "model", [](const Jet& j) { return std::string(model_name(j.stored().model)); },
          "The system's model, as in scenes.")
      .def_property_readonly(
          "precision",
          [](const Jet& j) {
            return j.stored().precision == Precision::extended ? "extended" : "double";
          },
          "In which it was computed: double or extended (113 bits).")
      .def_property_readonly(
          "order", [](const Jet& j) { return j.stored().order(); }, "Degree N of the polynomials.")
      .def_property_readonly(
          "variables",
          [](const Jet& j) { return py::tuple(py::cast(names(j.stored(), j.stored().variables))); },
          "Names of the initial deviations it is expanded in.")
      .def_property_readonly(
          "components",
          [](const Jet& j) {
            return py::tuple(py::cast(names(j.stored(), j.stored().components)));
          },
          "Names of the components of the final state; those left out stay zero.")
      .def_property_readonly(
          "units", [](const Jet& j) { return j.stored().units; }, "Canonical units in km and s.")
      .def_property_readonly(
          "start_canonical", [](const Jet& j) { return j.stored().start_time.in<double>(); },
          "The time of the system's clock at which the flow starts: 0, the epoch, for that of a "
          "run, the end's for an inverse.")
      .def_property_readonly(
          "duration_canonical", [](const Jet& j) { return j.stored().duration; },
          "Duration of the flow; negative: backwards.")
      .def_property_readonly(
          "duration_s", [](const Jet& j) { return j.stored().duration * j.stored().units.time_s; },
          "The same in seconds.")
      .def_property_readonly(
          "nominal_initial",
          [keep](const py::object& self) {
            const auto& state = keep(self)->stored().nominal_initial;
            return view(state.data(), {size_of(state.size())}, self);
          },
          "(2n,) float64: initial state (q, p) of the nominal, of all variables of the system.")
      .def_property_readonly(
          "nominal_final",
          [keep](const py::object& self) {
            const auto& state = keep(self)->stored().nominal_final;
            return view(state.data(), {size_of(state.size())}, self);
          },
          "(2n,) float64: final state (q, p) of the nominal.")
      .def_property_readonly(
          "coefficients",
          [keep](const py::object& self) {
            const auto pointer = keep(self);
            return view(
                pointer->coefficients().data(),
                {size_of(pointer->stored().components.size()), size_of(pointer->space()->size())},
                self);
          },
          "(components, count) float64, a read-only view.")
      .def_property_readonly(
          "exponents",
          [keep](const py::object& self) {
            const SeriesSpace& space = *keep(self)->space();
            return view(space.exponents(0).data(),
                        {size_of(space.size()), size_of(space.variables())}, self);
          },
          "(count, variables) uint8, a read-only view.")
      .def_property_readonly("linear_part", &linear_part,
                             "(components, variables) float64: the state transition matrix.")
      .def("__repr__", &representation);
}

}  // namespace

void bind_jets(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(DegreeRow, degree, absolute, scaled);
  bind_units(module);
  py::class_<Jet, JetPointer> jet(module, "Jet", jet_doc);
  bind_description(jet);
  bind_copies(jet);
  jet.def("evaluate", &evaluate, py::arg("deviations"), py::kw_only(), py::arg("out") = py::none(),
          py::arg("degree") = py::none(),
          documented("evaluate(self, deviations, *, out=None, degree=None)", evaluate_doc).c_str())
      .def(
          "__call__",
          [](const Jet& self, const py::object& deviations) {
            return evaluate(self, deviations, py::none(), std::nullopt);
          },
          py::arg("deviations"),
          documented("__call__(self, deviations)", "evaluate(deviations).").c_str())
      .def("evaluate_relative", &evaluate_relative_states, py::arg("states"), py::kw_only(),
           py::arg("frame") = "RTN", py::arg("to") = py::none(),
           py::arg("derivatives") = py::none(), py::arg("degree") = py::none(),
           py::arg("strict") = false,
           documented("evaluate_relative(self, states, *, frame='RTN', to=None, "
                      "derivatives=None, degree=None, strict=False)",
                      evaluate_relative_doc)
               .c_str())
      .def("jacobian", &jacobian, py::arg("deviations"),
           documented("jacobian(self, deviations)", jacobian_doc).c_str())
      .def("compose", &composition, py::arg("after").none(false),
           documented("compose(self, after)", compose_doc).c_str())
      .def(
          "__matmul__",
          [](const JetPointer& self, const JetPointer& before) {
            return composition(before, self);
          },
          py::is_operator(), py::arg("before").none(false),
          documented("__matmul__(self, before)", matmul_doc).c_str())
      .def(
          "inverse",
          [](const JetPointer& self) {
            return interruptibly(py::none(),
                                 [self](const ProgressCallback&) { return self->inverse(); });
          },
          documented("inverse(self)", inverse_doc).c_str())
      .def(
          "invert_partially",
          [](const JetPointer& self, const std::string& kind) {
            return interruptibly(py::none(), [self, kind](const ProgressCallback&) {
              return InvertedJet(*self, kind);
            });
          },
          py::arg("kind"), documented("invert_partially(self, kind)", invert_partially_doc).c_str())
      .def(
          "exactness",
          [](const JetPointer& self, const std::string& kind) {
            return by_degree(interruptibly(py::none(), [self, kind](const ProgressCallback&) {
              return InvertedJet(*self, kind).exactness();
            }));
          },
          py::arg("kind"),
          documented("exactness(self, kind)", "invert_partially(kind).exactness.").c_str())
      .def(
          "symplecticity",
          [](const JetPointer& self) {
            return by_degree(interruptibly(
                py::none(), [self](const ProgressCallback&) { return self->symplecticity(); }));
          },
          documented("symplecticity(self)", symplecticity_doc).c_str());
  bind_jet_arrays(jet);
  bind_jet_files(module, jet);
}

}  // namespace hamjet::python
