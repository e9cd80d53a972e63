#include <algorithm>
#include <cmath>

#include "../algebra/instantiated_real.hpp"
#include "hamjet/algebra/calculus.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/algebra/elementary_functions.hpp"
#include "hamjet/charts/flow_box.hpp"
#include "steady_turn.hpp"

namespace hamjet {
namespace {

using Component = Series<Extended>;

/// The derivatives of a function on the section, by the coordinates of the pairs and by the energy,
/// with the sizes of their terms.
struct Derivatives {
  std::vector<Component> by_place;  ///< q_2, q_3, p_2, p_3
  Component by_energy;
};

Component sizes(Component series) {
  for (Extended& c : series.coefficients()) c = abs(c);
  return series;
}

/// The sum over the two pairs of f_q g_p + sign f_p g_q. `sign` is -1 for the bracket, and 1 for
/// the sum of the sizes of its terms.
Component bracket(const std::vector<Component>& f, const std::vector<Component>& g, int sign) {
  const auto product = [&](std::size_t i, std::size_t j) { return f[i] * g[j]; };
  return product(0, 2) + product(1, 3) + Extended(sign) * (product(2, 0) + product(3, 1));
}

std::vector<Component> sizes(std::vector<Component> list) {
  for (Component& component : list) component = sizes(std::move(component));
  return list;
}

class Defects {
 public:
  explicit Defects(const SeriesSpace& space)
      : space_(space), result_(static_cast<std::size_t>(space.order())), scales_(result_.size()) {}

  void add(const Component& defect, const Component& terms) {
    for (std::size_t k = 0; k < space_.first(space_.order()); ++k) {
      const auto d = static_cast<std::size_t>(space_.degree(k));
      result_[d].absolute = std::max(result_[d].absolute, std::abs(static_cast<double>(defect[k])));
      scales_[d] = std::max(scales_[d], std::abs(static_cast<double>(terms[k])));
    }
  }

  std::vector<SymplecticityDefect> take() {
    for (std::size_t d = 0; d < result_.size(); ++d) {
      result_[d].degree = static_cast<int>(d);
      result_[d].scaled = scales_[d] > 0 ? result_[d].absolute / scales_[d] : result_[d].absolute;
    }
    return std::move(result_);
  }

 private:
  const SeriesSpace& space_;
  std::vector<SymplecticityDefect> result_;
  std::vector<double> scales_;
};

}  // namespace

template <class Real>
std::vector<SymplecticityDefect> FlowBoxMap<Real>::symplecticity() const {
  const SpacePointer& space = time.space_pointer();
  // The functions including the steady motion.
  const SteadyMotion<Series<Real>> motion = steady();
  const Series<Real> flight = time + motion.time;
  const std::vector<std::size_t> of_pairs = {1, 2, 4, 5};
  const Series<Real> zero(space);
  SixNumbers<Series<Real>> psi = {zero, zero, zero, zero, zero, zero};
  for (std::size_t k = 0; k < end->places().size(); ++k) psi[end->places()[k]] = coordinates[k];
  const std::optional<std::size_t> ignored = start->ignored();
  if (ignored) psi[*ignored] = coordinates.back() + motion.node;
  turn_steadily(*end, motion, psi);
  // The derivative d u_0 / dE: where the chief is bound, E = E_chief (1 + u_0)^(-2/3).
  Component by_energy(space, Extended(1) / Extended(start->energy_unit()));
  if (start->is_bound()) {
    by_energy = pow(convert_series<Extended>(start->periods(space)), Extended(5) / 3) *
                (Extended(-1.5) / Extended(start->energy()));
  }
  const auto derivatives = [&](const Series<Real>& f, std::optional<std::size_t> place) {
    const Component whole = convert_series<Extended>(f);
    Derivatives result{{}, derivative(whole, 0) * by_energy};
    for (const std::size_t i : of_pairs) {
      const auto found = std::find(start->places().begin(), start->places().end(), i);
      if (found == start->places().end()) {
        // The ignored coordinate appears in its own function alone, as an added term.
        result.by_place.emplace_back(space, Extended(place == i ? 1 : 0));
      } else {
        result.by_place.push_back(
            derivative(whole, static_cast<std::size_t>(found - start->places().begin()) + 1));
      }
    }
    return result;
  };
  const Derivatives of_time = derivatives(flight, {});
  std::vector<Derivatives> of_psi;
  for (const std::size_t i : of_pairs) of_psi.push_back(derivatives(psi[i], i));
  Defects defects(*space);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::vector<Component>& f = of_psi[i].by_place;
    Component along = of_psi[i].by_energy - bracket(of_time.by_place, f, -1);
    defects.add(along, sizes(of_psi[i].by_energy) + bracket(sizes(of_time.by_place), sizes(f), 1));
    for (std::size_t j = i + 1; j < 4; ++j) {
      const std::vector<Component>& g = of_psi[j].by_place;
      Component value = bracket(f, g, -1);
      if (j == i + 2) value[0] -= Extended(1);
      defects.add(value, bracket(sizes(f), sizes(g), 1));
    }
  }
  return defects.take();
}

template std::vector<SymplecticityDefect> FlowBoxMap<InstantiatedReal>::symplecticity() const;

}  // namespace hamjet
