#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "../../formats/relative_frame_text.hpp"
#include "../../store/csv_values.hpp"
#include "hamjet/report/relative_motion_report.hpp"
#include "transfer_view.hpp"

namespace hamjet::io {
namespace {

/// A condition, which may be infinite; empty where it was not found, which is NaN.
std::string condition(double value) { return std::isnan(value) ? "" : csv_number(value); }

std::string transfers_header(const Scene& scene) {
  std::string line =
      "time_canonical,time_s,kind,condition,position_condition,singular_distance_s,near_singular,"
      "beyond_tolerance,answer";
  for (const char* end : {"start", "end"}) {
    for (const std::string_view axis : axis_columns(scene.transfer->frame)) {
      line += fmt::format(",{}_change_{}_m_s", end, axis);
    }
  }
  line += ",total_change_m_s,linear_total_change_m_s";
  for (int order = 1; order <= scene.order; ++order) line += fmt::format(",miss_m_order_{}", order);
  return line +
         ",refined_total_change_m_s,refined_miss_m,refinement_flights,hamilton_jacobi_residual,"
         "failure\n";
}

std::string changes(const TransferAnswer* answer) {
  if (answer == nullptr) return ",,,,,,,";
  std::string fields;
  for (const Eigen::Vector3d* change : {&answer->start_change_m_s, &answer->end_change_m_s}) {
    for (const double component : *change) fields += "," + csv_number(component);
  }
  return fields + "," + csv_number(answer->total_change_m_s());
}

std::string refined_fields(const TransferPoint& point) {
  if (!point.refined) return ",,,";
  const bool is_found = point.refined->failure.empty();
  return fmt::format(",{},{},{}", is_found ? csv_number(point.refined->total_change_m_s()) : "",
                     is_found ? csv_number(point.refined->miss_m) : "", point.refinement_flights);
}

}  // namespace

std::string transfers_csv(const TransferResult& result) {
  const double unit = result.scene.units.time_s;
  std::string text = transfers_header(result.scene);
  for (const TransferPoint& point : result.points) {
    std::optional<double> distance;
    if (point.singular_distance) distance = *point.singular_distance * unit;
    text += fmt::format("{},{},{},{},{},{},{},{},{}", csv_number(point.time),
                        csv_number(point.time * unit), point.kind ? point.kind->name() : "",
                        point.kind ? condition(point.condition) : "",
                        condition(point.position_condition), csv_number(distance),
                        point.is_near_singular, point.is_beyond_tolerance, answer_name(point));
    text += changes(shown_answer(point));
    const TransferAnswer* linear = answer_of_order(point, 1);
    text += "," + (linear != nullptr ? csv_number(linear->total_change_m_s()) : "");
    for (int order = 1; order <= result.scene.order; ++order) {
      const TransferAnswer* answer = answer_of_order(point, order);
      text += "," + (answer != nullptr ? csv_number(answer->miss_m) : "");
    }
    text += refined_fields(point) + "," + csv_number(point.hamilton_jacobi_residual) + "," +
            csv_field(failure_text(point)) + "\n";
  }
  return text;
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
