#include "../formation/transfer_json.hpp"
#include "domains_table.hpp"
#include "moments_table.hpp"
#include "uncertainty_report.hpp"
#include "uncertainty_view.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

/// The columns of the distribution whose first component is in a row, those of components as
/// arrays, without what it has not; `row` moves on to the next distribution.
Json moments_json(const TableView& table, std::size_t& row) {
  const std::size_t components = table.dimensions[1].length;
  Json json;
  for (const TableColumn& column : table.columns) {
    if (column.level == 0 || !column.is_in_json) continue;
    const std::size_t cell = table.cell_of_row(column, row);
    Json value = cell_json(column, cell);
    if (value.is_null()) continue;
    if (column.level == 2) {
      value = Json::array();
      for (std::size_t i = 0; i < components; ++i) value.push_back(cell_json(column, cell + i));
    }
    json[column.name] = std::move(value);
  }
  row += components;
  return json;
}

Json family_json(const MomentsFamily& family, const TableView& table, std::size_t& row) {
  Json json = {{"polynomials", family.polynomials}, {"told_in", family.told_in}};
  Json names = Json::array();
  for (const StateComponent& component : family.components) names.push_back(component.name);
  json["components"] = names;
  json["orders"] = Json::array();
  for (std::size_t n = 0; n < family.by_order->size(); ++n) {
    json["orders"].push_back(moments_json(table, row));
  }
  return json;
}

Json state_json(const UncertaintyResult& result, const UncertaintyAt& at,
                const UncertainState& state, const TableView& table, std::size_t& row) {
  Json json = {{"name", state.name}, {"families", Json::array()}};
  for (const MomentsFamily& family : moments_families(result, at, state)) {
    json["families"].push_back(family_json(family, table, row));
  }
  json["quadrature_doubt"] = state.through.empty() ? Json(nullptr) : Json(state.through_doubt);
  json["flown"] = nullptr;
  if (state.flown) {
    json["flown"] = moments_json(table, row);
    json["flown"]["samples"] = state.flown->count;
  }
  const auto misleads = [&](double error) {
    return result.scene.order == 1 ? Json(nullptr) : Json(error > misleading_probability);
  };
  json["linear_misleads"] = misleads(linear_error_of_component(judged_orders(state)));
  json["linear_misleads_of_combinations"] =
      misleads(linear_error_of_probability(judged_orders(state)));
  return json;
}

}  // namespace

Json uncertainty_json(const UncertaintyResult& result) {
  const UncertaintySettings& settings = *result.scene.uncertainty;
  Json json = study_head_json(result.scene, "uncertainty", result.integrator);
  const TableView table = moments_table(result);
  json.update(table_json(table));
  json["seed"] = settings.seed;
  json["times"] = Json::array();
  std::size_t row = 0;
  for (const UncertaintyAt& at : result.points) {
    Json states = Json::array();
    for (const UncertainState& state : at.states) {
      states.push_back(state_json(result, at, state, table, row));
    }
    json["times"].push_back({{"time_canonical", told_time(result.scene, at.time)},
                             {"time_s", at.time * result.scene.units.time_s},
                             {"states", states}});
  }
  if (!result.domains.empty()) {
    json["split"] = Json::array();
    for (const UncertaintyDomains& of : result.domains) {
      json["split"].push_back({{"spacecraft", of.spacecraft},
                               {"count", of.domains.size()},
                               {"jets", of.maps},
                               {"right", of.is_right},
                               {"error_m", of.error_m},
                               {"quadrature_doubt", of.doubt}});
    }
    json.update(table_json(domains_table(result)));
  }
  if (!result.parameter_effects.empty()) {
    Json effects = Json::array();
    for (const ParameterEffect& effect : result.parameter_effects) {
      Json along = Json::object();
      for (const ParameterEffect::Along& one : effect.along) {
        along[one.state] = std::vector<double>(one.deviations.begin(), one.deviations.end());
      }
      effects.push_back({{"parameter", effect.parameter},
                         {"spacecraft", effect.spacecraft},
                         {"deviation", effect.deviation},
                         {"linear_deviations_m_m_s", along}});
    }
    json["uncertain_parameters"] = effects;
  }
  json["seconds"] = {{"propagation", result.propagation_seconds},
                     {"moments", result.moments_seconds},
                     {"flights", result.flight_seconds}};
  json["exit_code"] = 0;
  return json;
}

}  // namespace hamjet::io
