#include "uncertainty_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "../../algebra/symmetric_eigenvalues.hpp"
#include "../../formats/relative_frame_text.hpp"
#include "../../studies/formation/charts/free_coordinates.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/time_axis.hpp"

namespace hamjet::io {
namespace {

std::string told_state(const UncertainState& state) {
  return state.name == "relative" ? "the deputy relative to its chief" : "the " + state.name;
}

std::string probability_text(double error) {
  return error >= 1 ? "anything" : fmt::format("{:.2g}", error);
}

/// The component of which the linear standard deviation is most wrong.
Eigen::Index worst_component(const std::vector<Cumulants>& by_order) {
  const Vector<double> linear = by_order.front().standard_deviations();
  const Vector<double> full = by_order.back().standard_deviations();
  Eigen::Index worst = 0;
  double most = -1;
  for (Eigen::Index i = 0; i < full.size(); ++i) {
    if (linear[i] == 0 || full[i] == 0) continue;
    const double ratio = std::abs(std::log(full[i] / linear[i]));
    if (ratio > most) worst = i;
    most = std::max(most, ratio);
  }
  return worst;
}

/// The combination of components of which the linear standard deviation is most too small.
struct Combination {
  double position_m = 0;    ///< how far one linear standard deviation of it is, at most
  double velocity_m_s = 0;  ///< the same of the velocity
  double ratio = 1;         ///< its standard deviation by all orders over the linear one
};

/// None where the linear covariance vanishes.
std::optional<Combination> worst_combination(const std::vector<Cumulants>& by_order) {
  const Cumulants& linear = by_order.front();
  if (linear.rank() == 0) return std::nullopt;
  // In units of the standard deviations, of which an exact component has none.
  const Vector<double> deviations =
      linear.standard_deviations().unaryExpr([](double s) { return s > 0 ? s : 1.0; });
  const Matrix<double> axes = deviations.cwiseInverse().asDiagonal() * linear.axes();
  const Matrix<double> full = deviations.cwiseInverse().asDiagonal() * by_order.back().axes();
  // The columns of the axes are orthogonal.
  const Matrix<double> white =
      axes.colwise().squaredNorm().cwiseInverse().asDiagonal() * (axes.transpose() * full);
  const auto solver =
      symmetric_eigenvalues("uncertainty", Matrix<double>(white * white.transpose()));
  // Eigenvalues ascend; what the linear covariance is too wide in changes probabilities less.
  const Eigen::Index worst = linear.rank() - 1;
  const Vector<double> step = linear.axes() * solver.eigenvectors().col(worst);
  const Eigen::Index half = step.size() / 2;
  return Combination{step.head(half).norm(), step.tail(half).norm(),
                     std::sqrt(std::max(0.0, solver.eigenvalues()[worst]))};
}

/// The verdict where the linear covariance is right of each component but not of all together.
std::string combinations_text(const std::vector<Cumulants>& by_order, double of_components,
                              double of_all, int order) {
  std::string text = fmt::format(
      "holds for each component alone, of which a probability may be wrong by up to {}, but not "
      "for all together, of which one may be wrong by {}{}",
      probability_text(of_components), of_all >= 1 ? "" : "up to ", probability_text(of_all));
  if (by_order.back().rank() > by_order.front().rank()) {
    text +=
        fmt::format(": in some combination it has no spread at all, where order {} has one", order);
  } else if (const auto worst = worst_combination(by_order)) {
    text += fmt::format(
        ": most where one linear standard deviation is {:.2g} m and {:.2g} m/s, by order {} {:.3g} "
        "times that",
        worst->position_m, worst->velocity_m_s, order, worst->ratio);
  }
  return text;
}

}  // namespace

std::vector<StateComponent> state_components(const UncertaintyResult& result) {
  std::vector<StateComponent> components;
  const SystemSettings& system = result.scene.system;
  const auto names = component_names(system, result.scene.uncertainty->frame);
  for (const std::size_t place : told_components(system)) {
    components.push_back({names[place], place < 3 ? "m" : "m/s"});
  }
  return components;
}

std::vector<MomentsFamily> moments_families(const UncertaintyResult& result,
                                            const UncertaintyAt& at, const UncertainState& state) {
  const std::vector<StateComponent> components = state_components(result);
  const std::string frame(frame_name(result.scene.uncertainty->frame));
  std::vector<MomentsFamily> families = {
      {"cartesian", frame, &state.cartesian, &state.cartesian.front(), components}};
  const std::string name(name_of(result.coordinates));
  if (!state.through.empty())
    families.push_back({name, frame, &state.through, &state.cartesian.front(), components});
  if (!state.split.empty())
    families.push_back({"domains", frame, &state.split, &state.cartesian.front(), components});
  if (!state.charted.empty()) {
    std::vector<StateComponent> coordinates;
    for (const std::string& coordinate : at.charted_names) coordinates.push_back({coordinate, ""});
    families.push_back({name, name, &state.charted, &state.charted.front(), coordinates});
  }
  if (&at != &result.points.back()) return families;
  for (const MomentsInCoordinates& compared : result.in_coordinates) {
    const std::string other(name_of(compared.coordinates));
    for (std::size_t s = 0; s < compared.states.size(); ++s) {
      // The scene's own are there already.
      if (compared.states[s] != state.name || (other == name && !state.charted.empty())) continue;
      std::vector<StateComponent> coordinates;
      for (const std::string& component : compared.components) {
        coordinates.push_back({component, ""});
      }
      const std::vector<Cumulants>& by_order = compared.by_order[s];
      families.push_back({other, other, &by_order, &by_order.front(), coordinates, true});
    }
  }
  return families;
}

std::vector<Cumulants> judged_orders(const UncertainState& state) {
  if (state.split.empty()) return state.cartesian;
  return {state.cartesian.front(), state.split.back()};
}

std::vector<GaussianityInCoordinates> gaussianity_in_coordinates(const UncertaintyResult& result,
                                                                 const UncertainState& state) {
  std::vector<GaussianityInCoordinates> all;
  for (const MomentsInCoordinates& compared : result.in_coordinates) {
    all.push_back({std::string(name_of(compared.coordinates)), 0, true, 0, compared.refusal});
    for (std::size_t s = 0; s < compared.states.size(); ++s) {
      if (compared.states[s] != state.name) continue;
      all.back().negentropy = compared.by_order[s].back().negentropy();
      all.back().is_sure =
          is_negentropy_sure(compared.by_order[s], compared.by_order[s].size() - 1);
      all.back().error_of_linear = linear_error_of_probability(compared.by_order[s]);
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& one, const auto& other) {
    if (one.refusal.empty() != other.refusal.empty()) return one.refusal.empty();
    return one.negentropy < other.negentropy;
  });
  return all;
}

std::string time_text(const UncertaintyResult& result, const UncertaintyAt& at) {
  const double seconds = at.time * result.scene.units.time_s;
  const TimeAxis axis = time_axis(std::abs(seconds));
  return fmt::format("{:.4g} {}", seconds / axis.seconds, axis.name);
}

const UncertainState& judged_state(const UncertaintyAt& at) { return at.states.back(); }

double linear_error_of_probability(const std::vector<Cumulants>& by_order) {
  return largest_error_of_probability(divergence_from_linear(by_order));
}

double linear_error_of_component(const std::vector<Cumulants>& by_order) {
  double largest = 0;
  const Eigen::Index count = by_order.front().size();
  for (Eigen::Index i = 0; i < count; ++i) {
    const Matrix<double> component = Matrix<double>::Identity(count, count).row(i);
    largest = std::max(largest,
                       largest_error_of_probability(divergence_from_gaussian(
                           by_order.back().mapped(component), by_order.front().mapped(component))));
  }
  return largest;
}

std::string uncertainty_answer(const UncertaintyResult& result) {
  const UncertaintyAt& at = result.points.back();
  const UncertainState& state = judged_state(at);
  const Vector<double> deviations = judged_orders(state).back().standard_deviations();
  const std::vector<StateComponent> components = state_components(result);
  const std::size_t count = components.size() / 2;
  std::string along;
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) along += i + 1 == count ? " and " : ", ";
    along += fmt::format("{} along {}", length_text(deviations[static_cast<Eigen::Index>(i)]),
                         components[i].name);
  }
  return fmt::format("After {} the position of {} has the standard deviation{} {} by order {}.",
                     time_text(result, at), told_state(state), count == 1 ? "" : "s", along,
                     result.scene.order);
}

std::string uncertainty_judgement(const UncertaintyResult& result) {
  const UncertainState& state = judged_state(result.points.back());
  const int order = result.scene.order;
  std::string text;
  if (order == 1) {
    text =
        "The covariance is known to first order alone, which cannot say how far it misleads; a "
        "jet.order of 2 or more does.";
  } else {
    const std::vector<Cumulants> by_order = judged_orders(state);
    const double error = linear_error_of_component(by_order);
    const double of_all = linear_error_of_probability(by_order);
    const bool misleads = of_all > misleading_probability;
    const Eigen::Index worst = worst_component(by_order);
    const StateComponent component = state_components(result)[static_cast<std::size_t>(worst)];
    const std::string judgement =
        misleads && error <= misleading_probability
            ? combinations_text(by_order, error, of_all, order)
            : fmt::format("{}: a probability {} may be wrong by {}{}",
                          misleads ? "misleads" : "holds",
                          misleads ? "of one component alone" : "that it gives",
                          (misleads ? error : of_all) >= 1 ? "" : "up to ",
                          probability_text(misleads ? error : of_all));
    text = fmt::format(
        "By then the linear covariance of {} {}; the standard deviation along {} is {:.4g} {} by "
        "order "
        "{}, and {:.4g} {} by the linear theory.",
        told_state(state), judgement, component.name, by_order.back().standard_deviations()[worst],
        component.unit, order, by_order.front().standard_deviations()[worst], component.unit);
    if (!state.charted.empty()) {
      const double charted = linear_error_of_probability(state.charted);
      text += fmt::format(
          " In {} coordinates the distribution {} that of the linear theory: there a probability "
          "may be wrong by {}{}.",
          name_of(result.coordinates), charted > misleading_probability ? "is not" : "is still",
          charted >= 1 ? "" : "up to ", probability_text(charted));
    } else if (misleads && is_orbit(result.scene.system.model) && !result.scene.system.earth) {
      text += " In flow-box coordinates (jet.coordinates) a distribution stays Gaussian longer.";
    }
  }
  const auto compared = gaussianity_in_coordinates(result, state);
  // Coordinates that do not exist on this orbit come last.
  const auto last = std::find_if(compared.rbegin(), compared.rend(),
                                 [](const auto& one) { return one.refusal.empty(); });
  constexpr double alike =
      0.9;  // a ratio of negentropies that counts as alike: they may be leading terms alone
  if (last != compared.rend() && order > 1 &&
      compared.front().negentropy < alike * last->negentropy) {
    text += fmt::format(
        " Of the coordinates that are compared the distribution is nearest to Gaussian in {} ones "
        "(negentropy {} nats).",
        compared.front().coordinates,
        negentropy_text(compared.front().negentropy, compared.front().is_sure));
  }
  return text;
}

std::string uncertainty_verdict(const UncertaintyResult& result) {
  return uncertainty_answer(result) + " " + uncertainty_judgement(result);
}

namespace {

/// Whether a negentropy is so large that its leading terms say little: those of a shear are wrong
/// by a third from here on.
bool needs_more_than_leading_terms(double negentropy) { return negentropy >= 0.05; }

/// Whether a table has one after a tilde.
bool has_uncertain_negentropy(const UncertaintyResult& result) {
  const UncertaintyAt& last = result.points.back();
  for (const UncertainState& state : last.states) {
    for (const MomentsFamily& family : moments_families(result, last, state)) {
      for (std::size_t n = 0; n < family.by_order->size(); ++n) {
        const bool is_large = needs_more_than_leading_terms((*family.by_order)[n].negentropy());
        if (is_large && !is_negentropy_sure(*family.by_order, n)) return true;
      }
    }
  }
  return false;
}

/// What the deviations of a spacecraft were split into.
std::string domains_text(const UncertaintyResult& result, const UncertaintyDomains& of) {
  const DomainSettings& settings = *result.scene.uncertainty->domains;
  if (of.domains.size() == 1 && of.is_right) {
    return fmt::format(
        "One jet about the mean of the {} is right to {} within 3 standard deviations, by an "
        "estimate of {:.2g} m: nothing is split.",
        of.spacecraft, length_text(settings.tolerance_m), of.error_m);
  }
  const auto components = component_names(result.scene.uncertainty->frame);
  Vector<double> lowest = of.domains.front().centre, highest = lowest;
  for (const UncertaintyDomain& domain : of.domains) {
    lowest = lowest.cwiseMin(domain.centre);
    highest = highest.cwiseMax(domain.centre);
  }
  std::string where;
  for (Eigen::Index i = 0; i < 6; ++i) {
    if (!(highest[i] > lowest[i])) continue;
    where += fmt::format("{}{:.3g} to {:.3g} {} along {}", where.empty() ? "" : ", ", lowest[i],
                         highest[i], i < 3 ? "m" : "m/s", components[static_cast<std::size_t>(i)]);
  }
  std::string text = fmt::format(
      "Within 3 standard deviations the {} is split into {} domains, whose centres lie {} from its "
      "mean ({} jets were integrated); positions are right to {:.2g} m, by estimates",
      of.spacecraft, of.domains.size(), where, of.maps, of.error_m);
  if (!of.is_right) {
    text += fmt::format(
        ", and not to {}, for which most_domains ({}) would have to be more, or jet.order",
        length_text(settings.tolerance_m), settings.most_domains);
  }
  return text +
         fmt::format(
             ". Moments of domains are by quadrature, which a rule of fewer nodes changes by "
             "{:.1g} at most.",
             of.doubt);
}

}  // namespace

bool is_negentropy_sure(const std::vector<Cumulants>& by_order, std::size_t n) {
  constexpr double alike = 0.02;
  if (!by_order[n].is_negentropy_exact()) return false;
  if (n == 0) return true;
  const std::size_t beside = n + 1 < by_order.size() ? n + 1 : n - 1;
  const double own = by_order[n].negentropy();
  return std::abs(by_order[beside].negentropy() - own) <= alike * own;
}

std::string negentropy_text(double negentropy, bool is_sure) {
  // Smaller values are only the rounding of sums over some thousand coefficients.
  if (negentropy < 1e-12) return "0";
  const bool says_little = !is_sure && needs_more_than_leading_terms(negentropy);
  return fmt::format("{}{:.3g}", says_little ? "~" : "", negentropy);
}

std::vector<std::string> uncertainty_notes(const UncertaintyResult& result) {
  const UncertaintySettings& settings = *result.scene.uncertainty;
  std::vector<std::string> notes = result.start_notes;
  const auto mended = [&](const std::optional<StateUncertainty>& state, std::string_view whose) {
    if (!state || state->covariance.taken_as_zero() == 0) return;
    notes.push_back(
        fmt::format("The covariance of the {} has an eigenvalue of its correlations of -{:.1g}, "
                    "which is the rounding of its digits and was taken as zero.",
                    whose, state->covariance.taken_as_zero()));
  };
  mended(settings.chief, "chief");
  mended(settings.deputy, "deputy");
  if (settings.acceleration_density_m2_s3 > 0) {
    notes.push_back("What the noise of the acceleration adds is linear, in every order.");
  }
  if (settings.burn) {
    notes.push_back("The errors of the burn are taken to first order, as Gaussian ones.");
  }
  if (result.coordinates != JetCoordinates::cartesian) {
    bool has_through = true;
    double doubt = 0;
    for (const UncertaintyAt& at : result.points) {
      for (const UncertainState& state : at.states) {
        has_through = has_through && !state.through.empty();
        doubt = std::max(doubt, state.through_doubt);
      }
    }
    notes.push_back(
        has_through
            ? fmt::format("Moments along {} by polynomials in {} coordinates are by quadrature, "
                          "which a rule of fewer nodes changes by {:.1g} at most (standard "
                          "deviations relative, skewness and kurtosis absolute).",
                          frame_name(settings.frame), name_of(result.coordinates), doubt)
            : fmt::format("Moments along {} by polynomials in {} coordinates were not computed at "
                          "some time: some states have no place in these, or lie too far from the "
                          "chief for polynomials about it.",
                          frame_name(settings.frame), name_of(result.coordinates)));
  }
  for (const UncertaintyDomains& of : result.domains) notes.push_back(domains_text(result, of));
  for (const MomentsInCoordinates& compared : result.in_coordinates) {
    if (compared.refusal.empty()) continue;
    notes.push_back(fmt::format("No moments in {} coordinates: {}.", name_of(compared.coordinates),
                                compared.refusal));
  }
  if (has_uncertain_negentropy(result)) {
    notes.push_back(
        "A negentropy after ~ is the leading terms, of a distribution whose entropy is not known, "
        "or of polynomials that the next order changes; it tells no more than that the "
        "distribution is far from Gaussian.");
  }
  for (const UncertainState& state : result.points.back().states) {
    const std::vector<Cumulants>& told = !state.split.empty()    ? state.split
                                         : state.through.empty() ? state.cartesian
                                                                 : state.through;
    // Of order 2 nothing is known of convergence: what it changes is what is told of it.
    if (told.size() < 3) continue;
    const MomentsDifference change = difference_of(told.back(), told[told.size() - 2]);
    constexpr double much = 0.01;
    if (change.deviation <= much && change.skewness <= 10 * much) continue;
    notes.push_back(fmt::format(
        "Order {} changes a standard deviation of the {} by {:.2g} and a skewness by {:.2g} at the "
        "last time: a higher jet.order{} needed for moments that hold.",
        result.scene.order, state.name, change.deviation, change.skewness,
        is_orbit(result.scene.system.model) ? " or other jet.coordinates are" : " is"));
  }
  if (settings.samples < 2) notes.push_back("No samples were flown (uncertainty.samples).");
  return notes;
}

}  // namespace hamjet::io
