#include <pybind11/stl.h>

#include <memory>

#include "bindings.hpp"
#include "by_degree.hpp"
#include "evaluation.hpp"
#include "inverted_jet.hpp"
#include "pickling.hpp"
#include "signature.hpp"

namespace hamjet::python {
namespace {

constexpr const char* function_doc =
    R"(A generating function S(w) of a jet's map of deviations; immutable.

w are 2n variables: n of the final state, then n of the initial one (names with a 0 behind), all
deviations from the nominal, canonical. With k coefficients:

  coefficients   (k,) float64
  exponents      (k, 2n) uint8

both read-only views. S has the degrees 2 to N+1, N being the jet's order. For F1(q, q0) the
gradient is (p, -p0); in general it is, for a final pair, p_i where w = q_i and -q_i where w = p_i,
and for an initial pair -p0_i where w = q0_i and +q0_i where w = p0_i.)";

constexpr const char* exactness_doc =
    R"(How far the one-form behind S is from closed, degree by degree.

A structured array with the fields degree (0 to N-1), absolute and scaled: the largest coefficient
of d sigma_i / d w_j - d sigma_j / d w_i over all pairs, and the same divided by the largest of
d sigma_i / d w_j. It vanishes if and only if the map is symplectic; below the round-off that the
inversion amplifies it says nothing (the floor that a scene with [reference] states).)";

py::object values_at(const InvertedJet& f, const MapEvaluator& map, const py::object& w,
                     const py::object& out) {
  return evaluate_array(
      map, w, [&] { return f.variables(); }, out, "w");
}

}  // namespace

void bind_generating_functions(py::module_& module) {
  using Pointer = std::shared_ptr<InvertedJet>;
  const auto keep = [](const py::object& self) { return self.cast<Pointer>(); };
  py::class_<InvertedJet, Pointer> function(module, "GeneratingFunction", function_doc);
  bind_copies(function);
  function
      .def_property_readonly(
          "kind", [](const InvertedJet& f) { return f.kind().name(); },
          "In letters, final choice and initial choice: F1 of three degrees of freedom is qqq-qqq.")
      .def_property_readonly(
          "variables", [](const InvertedJet& f) { return py::tuple(py::cast(f.variables())); },
          "Names of the 2n variables w.")
      .def_property_readonly(
          "remaining_variables",
          [](const InvertedJet& f) { return py::tuple(py::cast(f.remaining_variables())); },
          "Names of the 2n variables that the kind does not take, what remaining() gives.")
      .def_property_readonly(
          "order", [](const InvertedJet& f) { return f.space()->order(); },
          "Degree of S, one more than the jet's.")
      .def_property_readonly(
          "condition", [](const InvertedJet& f) { return f.condition(); },
          "Condition number of the linear part that was inverted, in the 2-norm.")
      .def_property_readonly(
          "coefficients",
          [keep](const py::object& self) {
            const auto& numbers = keep(self)->coefficients();
            return view(numbers.data(), {size_of(numbers.size())}, self);
          },
          "(count,) float64, a read-only view.")
      .def_property_readonly(
          "exponents",
          [keep](const py::object& self) {
            const SeriesSpace& space = *keep(self)->space();
            return view(space.exponents(0).data(),
                        {size_of(space.size()), size_of(space.variables())}, self);
          },
          "(count, 2n) uint8, a read-only view.")
      .def_property_readonly(
          "exactness", [](const InvertedJet& f) { return by_degree(f.exactness()); }, exactness_doc)
      .def(
          "evaluate",
          [](const InvertedJet& f, const py::object& w) {
            const py::object values = values_at(f, f.value(), w, py::none());
            // With one component, (N, 1) becomes (N,), and (1,) a number.
            return values.attr("__getitem__")(py::make_tuple(py::ellipsis(), 0));
          },
          py::arg("w"),
          documented("evaluate(self, w)",
                     "Values of S, (N,), at w, (N, 2n); see Jet.evaluate for what w may be. The "
                     "columns of\na data frame are the variables.")
              .c_str())
      .def(
          "gradient",
          [](const InvertedJet& f, const py::object& w, const py::object& out) {
            return values_at(f, f.gradient(), w, out);
          },
          py::arg("w"), py::kw_only(), py::arg("out") = py::none(),
          documented("gradient(self, w, *, out=None)",
                     "Gradient of S by w, (N, 2n), at w, (N, 2n); of the degrees 1 to N.")
              .c_str())
      .def(
          "remaining",
          [](const InvertedJet& f, const py::object& w, const py::object& out) {
            return values_at(f, f.remaining(), w, out);
          },
          py::arg("w"), py::kw_only(), py::arg("out") = py::none(),
          documented("remaining(self, w, *, out=None)",
                     "The remaining variables, (N, 2n), at w, (N, 2n): the solution of the "
                     "boundary-value\nproblem that gives w, by the inverted map itself.")
              .c_str())
      .def("__repr__", [](const InvertedJet& f) {
        return "<hamjet.GeneratingFunction " + f.kind().name() + " of degree " +
               std::to_string(f.space()->order()) + ">";
      });
}

}  // namespace hamjet::python
