#include <fmt/format.h>

#include "../../formats/relative_frame_text.hpp"
#include "../../store/csv_values.hpp"
#include "../../store/json_values.hpp"
#include "../formation/transfer_json.hpp"
#include "uncertainty_report.hpp"
#include "uncertainty_view.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

Json numbers_json(const Vector<double>& numbers) {
  Json json = Json::array();
  for (const double number : numbers) json.push_back(json_number(number));
  return json;
}

Json matrix_json(const Matrix<double>& matrix) {
  Json json = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) json.push_back(numbers_json(matrix.row(i)));
  return json;
}

Json moments_json(const Cumulants& moments) {
  return {{"mean", numbers_json(moments.mean())},
          {"standard_deviations", numbers_json(moments.standard_deviations())},
          {"covariance", matrix_json(moments.covariance())},
          {"skewness", numbers_json(moments.skewness())},
          {"excess_kurtosis", numbers_json(moments.excess_kurtosis())},
          {"rank", moments.rank()},
          {"mardia_skewness", json_number(moments.mardia_skewness())},
          {"mardia_excess_kurtosis", json_number(moments.mardia_excess_kurtosis())},
          {"negentropy", json_number(moments.negentropy())}};
}

Json family_json(const MomentsFamily& family) {
  Json json = {{"polynomials", family.polynomials}, {"told_in", family.told_in}};
  Json names = Json::array();
  for (const StateComponent& component : family.components) names.push_back(component.name);
  json["components"] = names;
  json["orders"] = Json::array();
  for (std::size_t n = 0; n < family.by_order->size(); ++n) {
    Json order = {{"order", n + 1}};
    order.update(moments_json((*family.by_order)[n]));
    order["negentropy_is_sure"] = is_negentropy_sure(*family.by_order, n);
    const double divergence = divergence_from_gaussian((*family.by_order)[n], *family.linear);
    order["divergence_from_linear"] = json_number(divergence);
    order["probability_error_of_linear"] = json_number(largest_error_of_probability(divergence));
    json["orders"].push_back(order);
  }
  return json;
}

Json state_json(const UncertaintyResult& result, const UncertaintyAt& at,
                const UncertainState& state) {
  Json json = {{"name", state.name}, {"families", Json::array()}};
  for (const MomentsFamily& family : moments_families(result, at, state)) {
    json["families"].push_back(family_json(family));
  }
  json["quadrature_doubt"] = state.through.empty() ? Json(nullptr) : Json(state.through_doubt);
  json["flown"] = nullptr;
  if (state.flown) {
    json["flown"] = moments_json(state.flown->cumulants);
    json["flown"]["samples"] = state.flown->count;
    json["flown"]["scatter"] = {{"mean", numbers_json(state.flown->mean_error)},
                                {"standard_deviations", numbers_json(state.flown->deviation_error)},
                                {"skewness", numbers_json(state.flown->skewness_error)},
                                {"excess_kurtosis", numbers_json(state.flown->kurtosis_error)}};
  }
  const auto misleads = [&](double error) {
    return result.scene.order == 1 ? Json(nullptr) : Json(error > misleading_probability);
  };
  json["linear_misleads"] = misleads(linear_error_of_component(state.cartesian));
  json["linear_misleads_of_combinations"] = misleads(linear_error_of_probability(state.cartesian));
  return json;
}

}  // namespace

Json uncertainty_json(const UncertaintyResult& result) {
  const UncertaintySettings& settings = *result.scene.uncertainty;
  Json json = study_head_json(result.scene, "uncertainty", result.integrator);
  json["coordinates"] = name_of(result.coordinates);
  json["frame"] = frame_name(settings.frame);
  json["derivatives"] = text_or_null(std::string(derivatives_name(settings.frame)));
  json["units"] = "m, m/s; in other coordinates canonical, by the chief's distance at the start";
  json["verdict"] = uncertainty_verdict(result);
  json["notes"] = uncertainty_notes(result);
  json["misleading_probability"] = misleading_probability;
  json["samples"] = settings.samples < 2 ? 0 : settings.samples;
  json["seed"] = settings.seed;
  json["times"] = Json::array();
  for (const UncertaintyAt& at : result.points) {
    Json states = Json::array();
    for (const UncertainState& state : at.states) states.push_back(state_json(result, at, state));
    json["times"].push_back({{"time_canonical", told_time(result.scene, at.time)},
                             {"time_s", at.time * result.scene.units.time_s},
                             {"states", states}});
  }
  json["seconds"] = {{"propagation", result.propagation_seconds},
                     {"moments", result.moments_seconds},
                     {"flights", result.flight_seconds}};
  json["exit_code"] = 0;
  return json;
}

std::string moments_csv(const UncertaintyResult& result) {
  std::string text =
      "time_canonical,time_s,state,polynomials,told_in,order,component,unit,mean,"
      "standard_deviation,skewness,excess_kurtosis,mean_scatter,standard_deviation_scatter,"
      "skewness_scatter,excess_kurtosis_scatter\n";
  for (const UncertaintyAt& at : result.points) {
    for (const UncertainState& state : at.states) {
      const auto row = [&](const MomentsFamily& family, const std::string& polynomials,
                           const std::string& order, std::size_t component,
                           const Cumulants& moments, const FlownMoments* flown) {
        const auto i = static_cast<Eigen::Index>(component);
        text += fmt::format(
            "{},{},{},{},{},{},{},{},{},{},{},{}", csv_number(told_time(result.scene, at.time)),
            csv_number(at.time * result.scene.units.time_s), state.name, polynomials,
            family.told_in, order, family.components[component].name,
            family.components[component].unit, csv_number(moments.mean()[i]),
            csv_number(moments.standard_deviations()[i]), csv_number(moments.skewness()[i]),
            csv_number(moments.excess_kurtosis()[i]));
        text += flown ? fmt::format(",{},{},{},{}\n", csv_number(flown->mean_error[i]),
                                    csv_number(flown->deviation_error[i]),
                                    csv_number(flown->skewness_error[i]),
                                    csv_number(flown->kurtosis_error[i]))
                      : std::string(",,,,\n");
      };
      const auto families = moments_families(result, at, state);
      for (const MomentsFamily& family : families) {
        for (std::size_t n = 0; n < family.by_order->size(); ++n) {
          for (std::size_t i = 0; i < family.components.size(); ++i) {
            row(family, family.polynomials, std::to_string(n + 1), i, (*family.by_order)[n],
                nullptr);
          }
        }
      }
      if (!state.flown) continue;
      for (std::size_t i = 0; i < families.front().components.size(); ++i) {
        row(families.front(), "flown", "", i, state.flown->cumulants, &*state.flown);
      }
    }
  }
  return text;
}

}  // namespace hamjet::io
