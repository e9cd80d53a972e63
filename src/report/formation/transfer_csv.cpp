#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "answer_columns.hpp"
#include "hamjet/report/relative_motion_report.hpp"
#include "transfer_view.hpp"

namespace hamjet::io {
namespace {

/// A condition, which may be infinite; empty where it was not found, which is NaN.
std::string condition(double value) { return std::isnan(value) ? "" : csv_number(value); }

using TransferColumns = Columns<TransferPoint>;
using Point = const TransferPoint&;

void add_orders(TransferColumns& columns, int most) {
  columns.add("linear_total_change_m_s", [](Point point) {
    const TransferAnswer* linear = answer_of_order(point, 1);
    return linear != nullptr ? csv_number(linear->total_change_m_s()) : "";
  });
  for (int order = 1; order <= most; ++order) {
    columns.add(fmt::format("miss_m_order_{}", order), [order](Point point) {
      const TransferAnswer* answer = answer_of_order(point, order);
      return answer != nullptr ? csv_number(answer->miss_m) : "";
    });
  }
}

void add_refinement(TransferColumns& columns) {
  const auto is_refined = [](Point point) { return point.refined.has_value(); };
  const auto is_found = [](Point point) {
    return point.refined.has_value() && point.refined->failure.empty();
  };
  columns.add_if(is_found, "refined_total_change_m_s",
                 [](Point point) { return csv_number(point.refined->total_change_m_s()); });
  columns.add_if(is_found, "refined_miss_m",
                 [](Point point) { return csv_number(point.refined->miss_m); });
  columns.add_if(is_refined, "refinement_flights",
                 [](Point point) { return fmt::format("{}", point.refinement_flights); });
}

}  // namespace

std::string transfers_csv(const TransferResult& result) {
  const double unit = result.scene.units.time_s;
  const auto has_kind = [](Point point) { return point.kind.has_value(); };
  TransferColumns columns;
  columns.add("time_canonical", [](Point point) { return csv_number(point.time); });
  columns.add("time_s", [=](Point point) { return csv_number(point.time * unit); });
  columns.add_if(has_kind, "kind", [](Point point) { return point.kind->name(); });
  columns.add_if(has_kind, "condition", [](Point point) { return condition(point.condition); });
  columns.add("position_condition",
              [](Point point) { return condition(point.position_condition); });
  columns.add_if([](Point point) { return point.singular_distance.has_value(); },
                 "singular_distance_s",
                 [=](Point point) { return csv_number(*point.singular_distance * unit); });
  columns.add("near_singular",
              [](Point point) { return fmt::format("{}", point.is_near_singular); });
  columns.add("beyond_tolerance",
              [](Point point) { return fmt::format("{}", point.is_beyond_tolerance); });
  columns.add("answer", [](Point point) { return std::string(answer_name(point)); });
  add_answer_columns<TransferPoint>(columns, result.scene.transfer->frame,
                                    [](Point point) -> Point { return point; });
  add_orders(columns, result.scene.order);
  add_refinement(columns);
  columns.add("hamilton_jacobi_residual",
              [](Point point) { return csv_number(point.hamilton_jacobi_residual); });
  columns.add("failure", [](Point point) { return std::string(failure_text(point)); });
  return columns.csv(result.points);
}

std::string singular_times_csv(const TransferResult& result) {
  const double unit = result.scene.units.time_s;
  std::string text =
      "kind,time_canonical,time_s,resolution_s,smallest_ratio,second_ratio,directions_lost,"
      "direction_inertial_x,"
      "direction_inertial_y,direction_inertial_z,direction_r,direction_t,direction_n\n";
  for (const SingularTime& singular : result.singular_times) {
    text += fmt::format("{},{},{},{},{},{},{}", singular.kind.name(), csv_number(singular.time),
                        csv_number(singular.time * unit), csv_number(singular.resolution * unit),
                        csv_number(singular.smallest_ratio), csv_number(singular.second_ratio),
                        singular.directions_lost);
    for (const double component : singular.direction) text += "," + csv_number(component);
    for (Eigen::Index i = 0; i < 3; ++i) {
      text += "," + (singular.direction_rtn ? csv_number((*singular.direction_rtn)[i]) : "");
    }
    text += "\n";
  }
  return text;
}

std::string conditions_csv(const TransferResult& result) {
  const KindConditions& conditions = result.conditions;
  std::string text = "time_canonical,time_s";
  for (const GeneratingFunctionKind& kind : conditions.kinds) text += "," + kind.name();
  text += "\n";
  for (std::size_t i = 0; i < conditions.times.size(); ++i) {
    text += csv_number(conditions.times[i]) + "," +
            csv_number(conditions.times[i] * result.scene.units.time_s);
    for (const double value : conditions.values[i]) text += "," + condition(value);
    text += "\n";
  }
  return text;
}

}  // namespace hamjet::io
