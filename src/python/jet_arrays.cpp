#include "jet_arrays.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "../scene/scene_sections.hpp"
#include "../text/quantity_text.hpp"
#include "../text/scene_message.hpp"
#include "arrays.hpp"
#include "interruptible.hpp"
#include "refusal.hpp"
#include "signature.hpp"

namespace hamjet::python {
namespace {

using Names = std::optional<std::vector<std::string>>;

/// Digits of a table are no rounding of binary64, but a map that is off by more than its square
/// root was hardly meant to be symplectic.
constexpr double largest_silent_defect = 1e-8;

constexpr const char* from_arrays_doc =
    R"(A jet of coefficients that come from elsewhere, in canonical units.

coefficients: (components, count), finite. exponents: (count, variables), of the initial deviations,
each row once, in any order; a term that is not there is zero, and the row of zeros, which must be
there, has the nominal's final state. nominal_initial: (2n,), the state (q, p) of all variables of
the system, and behind it the numbers of the `state_parameters`, which are names. duration_canonical: of the flow. units: a Units. model: as in scenes, or "own" for a
Hamiltonian that they do not have. variables, components: names of those that the jet is expanded
in and has; by default all. scene, run: names for messages and files.

Whether it is the jet of a symplectic map is not required, but a RuntimeWarning says if it is not;
`symplecticity` has every degree. Raises UsageError for shapes and numbers that do not fit.)";

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Integers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

/// An array of so many dimensions of real numbers, or of whole ones alone. Throws Error(usage).
template <class Array>
Array array_from(const py::object& given, py::ssize_t dimensions, const std::string& what) {
  const bool is_whole = std::is_same_v<Array, Integers>;
  const py::array array = py::array::ensure(given);
  if (!array) PyErr_Clear();
  const std::string kinds = is_whole ? "iu" : "fiu";
  if (!array || kinds.find(array.dtype().kind()) == std::string::npos ||
      array.dtype().itemsize() > 8 || array.ndim() != dimensions) {
    refuse(fmt::format("from_arrays: {}: must be an array of {} with {}", what,
                       is_whole ? "integers" : "real numbers of at most 64 bits",
                       counted(dimensions, "dimension")));
  }
  return Array::ensure(array);
}

void require_finite(const Numbers& numbers, const std::string& what) {
  const double* const end = numbers.data() + numbers.size();
  const double* const wrong =
      std::find_if(numbers.data(), end, [](double x) { return !std::isfinite(x); });
  if (wrong == end) return;
  refuse(fmt::format("from_arrays: {}: not finite, got {} at position {}, must be finite", what,
                     *wrong, wrong - numbers.data()));
}

/// A name for messages and for a group of HDF5.
std::string name_from(const std::string& name, const std::string& what) {
  constexpr std::size_t longest = 100;
  if (name.empty() || name[0] == '.' || name.find('/') != std::string::npos ||
      io::printable(name, longest) != name) {
    refuse(
        fmt::format("from_arrays: {}: got {}, must be 1 to {} printable characters without a "
                    "slash, no dot first",
                    what, io::in_quotes(name), longest));
  }
  return name;
}

SystemModel model_from(const std::string& name) {
  const auto& names = model_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    refuse(fmt::format("from_arrays: model: got {}, {}", io::in_quotes(name),
                       io::suggestion(name, names)));
  }
  return static_cast<SystemModel>(found - names.begin());
}

std::vector<double> state_from(const py::object& given, SystemModel model, std::size_t parameters) {
  const auto numbers = array_from<Numbers>(given, 1, "nominal_initial");
  const std::vector<std::size_t> sizes = possible_dimensions(model, parameters);
  const auto size = static_cast<std::size_t>(numbers.size());
  if (std::find(sizes.begin(), sizes.end(), size) == sizes.end()) {
    refuse(fmt::format("from_arrays: nominal_initial: got {} numbers, must be {} of the model {}",
                       size, fmt::join(sizes, " or "), model_name(model)));
  }
  require_finite(numbers, "nominal_initial");
  return {numbers.data(), numbers.data() + size};
}

/// Indices of the names, which must ascend, among those of the model; all without names.
std::vector<std::size_t> indices_from(const Names& names, const std::vector<std::string_view>& all,
                                      const std::string& what) {
  std::vector<std::size_t> indices;
  if (!names) {
    for (std::size_t i = 0; i < all.size(); ++i) indices.push_back(i);
    return indices;
  }
  for (const std::string& name : *names) {
    const auto found = std::find(all.begin(), all.end(), name);
    const auto index = static_cast<std::size_t>(found - all.begin());
    if (found == all.end() || (!indices.empty() && index <= indices.back())) {
      refuse(fmt::format("from_arrays: {}: got {}, must be some of {}, in this order, each once",
                         what, io::in_quotes(name), fmt::join(all, ", ")));
    }
    indices.push_back(index);
  }
  if (indices.empty()) refuse(fmt::format("from_arrays: {}: empty, must be at least one", what));
  return indices;
}

/// The monomials that the rows of exponents stand for, in the space of their highest degree.
struct Monomials {
  SpacePointer space;
  std::vector<std::size_t> indices;
};

Monomials monomials_from(const Integers& exponents) {
  constexpr std::int64_t largest_order = io::largest_order;
  std::int64_t order = 0;
  const py::ssize_t variables = exponents.shape(1);
  for (py::ssize_t row = 0; row < exponents.shape(0); ++row) {
    std::int64_t degree = 0;
    for (py::ssize_t v = 0; v < variables; ++v) {
      const std::int64_t exponent = exponents.at(row, v);
      if (exponent < 0 || exponent > largest_order || (degree += exponent) > largest_order) {
        refuse(
            fmt::format("from_arrays: exponents: row {} has {}, must be from 0, of degree at "
                        "most {}",
                        row, exponent, largest_order));
      }
    }
    order = std::max(order, degree);
  }
  if (order == 0) refuse("from_arrays: exponents: got degree 0 alone, must be a map");
  Monomials monomials{
      SeriesSpace::create(static_cast<std::size_t>(variables), static_cast<int>(order)), {}};
  std::vector<bool> is_there(monomials.space->size());
  for (py::ssize_t row = 0; row < exponents.shape(0); ++row) {
    const std::vector<std::uint8_t> powers(exponents.data(row, 0),
                                           exponents.data(row, 0) + variables);
    const std::size_t index = monomials.space->index(powers);
    if (is_there[index]) {
      refuse(fmt::format("from_arrays: exponents: row {} is there twice, ({})", row,
                         fmt::join(powers, ", ")));
    }
    is_there[index] = true;
    monomials.indices.push_back(index);
  }
  if (!is_there[0]) {
    refuse(
        "from_arrays: exponents: without the row of zeros, whose coefficients must be the "
        "nominal's final state");
  }
  return monomials;
}

std::string dimensions_text(const py::array& array) {
  return fmt::format("({})", fmt::join(array.shape(), array.shape() + array.ndim(), ", "));
}

FlowJet<Extended> series_from(const Numbers& coefficients, const Integers& exponents,
                              const io::StoredJet& stored) {
  const auto components = size_of(stored.components.size());
  const auto variables = size_of(stored.variables.size());
  if (coefficients.shape(0) != components || exponents.shape(1) != variables ||
      coefficients.shape(1) != exponents.shape(0) || exponents.shape(0) == 0) {
    refuse(fmt::format(
        "from_arrays: got coefficients of shape {} and exponents of shape {}, must "
        "be ({}, count) and (count, {})",
        dimensions_text(coefficients), dimensions_text(exponents), components, variables));
  }
  require_finite(coefficients, "coefficients");
  const Monomials monomials = monomials_from(exponents);
  FlowJet<Extended> jet;
  for (py::ssize_t c = 0; c < components; ++c) {
    Series<Extended> component(monomials.space);
    for (std::size_t k = 0; k < monomials.indices.size(); ++k) {
      component[monomials.indices[k]] = Extended(coefficients.at(c, size_of(k)));
    }
    jet.push_back(std::move(component));
  }
  return jet;
}

/// Warns if this cannot be the jet of a symplectic map; parts of one cannot be judged.
void warn_if_not_symplectic(const std::shared_ptr<Jet>& jet) {
  const io::StoredJet& stored = jet->stored();
  const std::size_t all = stored.nominal_initial.size();
  if (stored.parameters > 0 || stored.components.size() != all || stored.variables.size() != all)
    return;
  const auto defects =
      interruptibly(py::none(), [jet](const ProgressCallback&) { return jet->symplecticity(); });
  const auto worst = std::max_element(defects.begin(), defects.end(),
                                      [](auto& a, auto& b) { return a.scaled < b.scaled; });
  if (worst->scaled <= largest_silent_defect) return;
  const std::string text = fmt::format(
      "from_arrays: not the jet of a symplectic map: the scaled defect is {:.2g} at "
      "degree {}; see symplecticity()",
      worst->scaled, worst->degree);
  if (PyErr_WarnEx(PyExc_RuntimeWarning, text.c_str(), 1) != 0) throw py::error_already_set();
}

std::shared_ptr<Jet> from_arrays(const py::object& coefficients, const py::object& exponents,
                                 const py::object& nominal_initial, double duration,
                                 const CanonicalUnits& units, const std::string& model,
                                 const Names& variables, const Names& components,
                                 const std::string& scene, const std::string& run,
                                 const Names& state_parameters) {
  io::StoredJet stored;
  stored.scene = name_from(scene, "scene");
  stored.label = name_from(run, "run");
  stored.model = model_from(model);
  stored.units = units;
  if (!std::isfinite(duration)) {
    refuse(fmt::format("from_arrays: duration_canonical: got {}, must be finite", duration));
  }
  stored.duration = duration;
  const std::vector<std::string> parameters = state_parameters.value_or(std::vector<std::string>());
  stored.nominal_initial = state_from(nominal_initial, stored.model, parameters.size());
  if (const auto problem = io::set_state_parameters(stored, parameters)) {
    refuse("from_arrays: state_parameters: " + *problem);
  }
  stored.variables = indices_from(variables, stored.variable_names(), "variables");
  stored.components = indices_from(components, stored.variable_names(), "components");
  stored.jet = series_from(array_from<Numbers>(coefficients, 2, "coefficients"),
                           array_from<Integers>(exponents, 2, "exponents"), stored);
  // Components that are left out stay zero.
  stored.nominal_final.assign(stored.nominal_initial.size(), 0);
  for (std::size_t c = 0; c < stored.components.size(); ++c) {
    stored.nominal_final[stored.components[c]] = static_cast<double>(stored.jet[c][0]);
  }
  auto jet = std::make_shared<Jet>(std::move(stored));
  warn_if_not_symplectic(jet);
  return jet;
}

}  // namespace

void bind_jet_arrays(py::class_<Jet, std::shared_ptr<Jet>>& jet) {
  jet.def_static(
      "from_arrays", &from_arrays, py::arg("coefficients"), py::arg("exponents"), py::kw_only(),
      py::arg("nominal_initial"), py::arg("duration_canonical"), py::arg("units"), py::arg("model"),
      py::arg("variables") = py::none(), py::arg("components") = py::none(),
      py::arg("scene") = "arrays", py::arg("run") = "arrays",
      py::arg("state_parameters") = py::none(),
      documented("from_arrays(coefficients, exponents, *, nominal_initial, duration_canonical, "
                 "units, model, variables=None, components=None, scene='arrays', run='arrays', "
                 "state_parameters=None)",
                 from_arrays_doc)
          .c_str());
}

}  // namespace hamjet::python
