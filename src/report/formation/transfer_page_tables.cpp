#include <fmt/format.h>

#include "../../formats/relative_frame_text.hpp"
#include "../../studies/formation/charts/free_coordinates.hpp"
#include "../../text/html_text.hpp"
#include "../../text/quantity_text.hpp"
#include "../drawing/report_page.hpp"
#include "frame_columns.hpp"
#include "transfer_page.hpp"
#include "transfer_view.hpp"

namespace hamjet::io {
namespace {

std::string number(double value) { return fmt::format("{:.5g}", value); }

/// The columns of both impulses.
std::vector<std::string> impulse_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const char* impulse : {"first", "second"}) {
    for (const std::string& axis : axis_letters(scene.system, scene.transfer->frame)) {
      names.push_back(fmt::format("{} {} (m/s)", impulse, axis));
    }
  }
  return names;
}

std::string impulse_cells(const TransferAnswer& answer, std::size_t count) {
  std::string cells;
  for (const Eigen::Vector3d* change : {&answer.start_change_m_s, &answer.end_change_m_s}) {
    for (const double component : along_told_axes(*change, count)) cells += cell(number(component));
  }
  return cells;
}

std::string answer_row(const std::string& name, const TransferAnswer& answer, std::size_t count,
                       double flight_floor_m) {
  if (!answer.failure.empty()) {
    return fmt::format("<tr class=\"failed\">{}<td class=\"reason\" colspan=\"{}\">{}</td></tr>\n",
                       row_name_cell(name), 2 + 2 * count, escape_html(answer.failure));
  }
  return "<tr>" + row_name_cell(name) + cell(number(answer.total_change_m_s())) +
         impulse_cells(answer, count) + cell(miss_text(answer.miss_m, flight_floor_m)) + "</tr>\n";
}

std::string marks_text(const TransferPoint& point) {
  std::string text;
  if (point.is_near_singular) text = "near a singularity";
  if (point.is_beyond_tolerance && shown_answer(point) != nullptr) {
    text += (text.empty() ? "" : ", ") + std::string("beyond the tolerance");
  }
  if (point.exceeds_impulse) text += (text.empty() ? "" : ", ") + std::string("impulse too large");
  if (point.enters_keep_out()) text += (text.empty() ? "" : ", ") + std::string("kept out");
  return text;
}

}  // namespace

std::string best_transfer_table_html(const TransferResult& result) {
  const auto best = result.best_point();
  if (!best) {
    return "<p>No transfer time has an answer that is within the tolerance and away from "
           "singularities.</p>\n";
  }
  const TransferPoint& point = result.points[*best];
  std::vector<std::string> names = {"answer", "both (m/s)"};
  for (std::string& name : impulse_names(result.scene)) {
    names.push_back(std::move(name));
  }
  names.emplace_back("miss");
  const std::size_t count = told_coordinates(result.scene.system);
  std::string rows;
  for (const TransferAnswer& answer : point.answers) {
    rows += answer_row(fmt::format("order {}", answer.order), answer, count, result.flight_floor_m);
  }
  if (point.refined) {
    rows += answer_row(fmt::format("refined, {}", counted(point.refinement_flights, "more flight")),
                       *point.refined, count, result.flight_floor_m);
  }
  return table_html(
      escape_html(fmt::format(
          "Velocity changes for the transfer in {}, generating function {} (condition {:.3g}), "
          "along the axes of the frame {} at the start and at the end, and the distance from the "
          "wanted end of a deputy that flew them.",
          time_text(point.time * result.scene.units.time_s),
          point.kind ? told_kind(*point.kind, result.scene.system) : "-", point.condition,
          frame_text(result.scene.transfer->frame))),
      "<tr>" + header_cells(names) + "</tr>", rows);
}

std::string miss_table_html(const TransferResult& result) {
  std::string rows;
  for (const MissStatistics& entry : miss_statistics(result)) {
    rows += "<tr>" + row_name_cell(entry.answer) + cell(std::to_string(entry.count)) +
            cell(miss_text(entry.median_m, result.flight_floor_m)) +
            cell(miss_text(entry.largest_m, result.flight_floor_m)) + "</tr>\n";
  }
  return table_html("Misses over all transfer times that are not near a singularity.",
                    "<tr>" + header_cells({"answer", "times", "median", "largest"}) + "</tr>",
                    rows);
}

std::string singular_table_html(const TransferResult& result) {
  const std::vector<SingularTime> times = result.position_singularities();
  if (times.empty()) return "<p>F1 exists at all times of the span.</p>\n";
  const bool is_along_own = result.scene.transfer->frame == RelativeFrame::coordinates;
  const std::size_t axes = axis_columns(result.scene.system, result.scene.transfer->frame).size();
  std::string rows;
  for (const SingularTime& singular : times) {
    const auto text = [&](const Eigen::Vector3d& direction) {
      return fmt::format("({:+.6f})", fmt::join(along_told_axes(direction, axes), ", "));
    };
    rows += "<tr>" + row_name_cell(singular_time_text(singular, result.scene.units.time_s, 6)) +
            cell(fmt::format("{:.12g}", told_time(result.scene, singular.time)));
    if (!is_along_own) {
      rows += cell(singular.direction_rtn ? text(*singular.direction_rtn) : "no orbital plane");
    }
    rows += cell(text(singular.direction)) + cell(fmt::format("{:.1e}", singular.smallest_ratio)) +
            cell(fmt::format("{:.1e}", singular.second_ratio)) + "</tr>\n";
  }
  std::vector<std::string> names = {"time (s)", "canonical"};
  if (is_along_own) {
    names.emplace_back("direction, along the coordinates");
  } else {
    names.insert(names.end(), {"direction, RTN", "direction, inertial"});
  }
  names.insert(names.end(), {"smallest ratio", "second ratio"});
  return table_html(
      fmt::format("Times at which F1 does not exist: no initial velocity commands the final "
                  "position along the direction, a unit vector {}. The ratios are the two smallest "
                  "singular values of dq/dp0 over the largest: two small ones say that a whole "
                  "plane of directions is lost, or nearly.",
                  is_along_own
                      ? "along the system's coordinates"
                      : "along the chief's R, T, N then, and along the inertial axes x, y, z"),
      "<tr>" + header_cells(names) + "</tr>", rows);
}

std::string transfers_table_html(const TransferResult& result) {
  std::vector<std::string> names = {"time (s)",    "kind",         "condition",   "both (m/s)",
                                    "first (m/s)", "second (m/s)", "linear (m/s)"};
  for (int order = 1; order <= result.scene.order; ++order) {
    names.push_back(fmt::format("miss, order {}", order));
  }
  if (result.scene.transfer->refine) names.emplace_back("miss, refined");
  const std::string head =
      "<tr>" + header_cells(names) + "<th scope=\"col\" class=\"text\">marks</th></tr>";
  std::string rows;
  for (const TransferPoint& point : result.points) {
    const std::string time =
        row_name_cell(fmt::format("{:.6g}", point.time * result.scene.units.time_s));
    const TransferAnswer* shown = shown_answer(point);
    if (shown == nullptr) {
      rows +=
          fmt::format("<tr class=\"failed\">{}<td class=\"reason\" colspan=\"{}\">{}</td></tr>\n",
                      time, names.size(), escape_html(failure_text(point)));
      continue;
    }
    const TransferAnswer* linear = answer_of_order(point, 1);
    rows += "<tr>" + time + cell(point.kind ? told_kind(*point.kind, result.scene.system) : "–") +
            cell(fmt::format("{:.3g}", point.condition)) + cell(number(shown->total_change_m_s())) +
            cell(number(shown->start_change_m_s.norm())) +
            cell(number(shown->end_change_m_s.norm())) +
            cell(linear != nullptr ? number(linear->total_change_m_s()) : "–");
    for (int order = 1; order <= result.scene.order; ++order) {
      const TransferAnswer* answer = answer_of_order(point, order);
      rows += cell(answer != nullptr ? miss_text(answer->miss_m, result.flight_floor_m) : "–");
    }
    if (result.scene.transfer->refine) {
      const bool is_refined = point.refined && point.refined->failure.empty();
      rows += cell(is_refined ? miss_text(point.refined->miss_m, result.flight_floor_m) : "–");
    }
    rows += fmt::format("<td class=\"reason\">{}</td></tr>\n", escape_html(marks_text(point)));
  }
  return table_html(
      "Velocity changes of the refined answer where there is one, else of the highest order; the "
      "kind in letters, final variables before the hyphen and initial ones behind it.",
      head, rows);
}

std::string seconds_table_html(const TransferResult& result) {
  const TransferSeconds& seconds = result.seconds;
  std::string rows;
  const auto row = [&](const char* name, double value) {
    rows += "<tr>" + row_name_cell(name) + cell(duration_text(value)) + "</tr>\n";
  };
  row("jets at all times, one integration", seconds.propagation);
  row("singular times and conditions of all kinds", seconds.singularities);
  row("inversions, one for each time", seconds.inversion);
  row("boundary values, all orders", seconds.solution);
  row("the study, the sum of these", seconds.study());
  row("proof by flying, and refinement", seconds.proof);
  row("Hamilton-Jacobi residuals", seconds.residual);
  if (result.thrust) row("thrust of least energy, flown", seconds.thrust);
  if (result.fuel) row("thrust of least fuel, flown", seconds.fuel);
  if (result.burns) row("burns in place of impulses, flown", seconds.burns);
  const std::string residual = hamilton_jacobi_text(result);
  return table_html("Wall-clock time on one core.",
                    "<tr>" + header_cells({"part", "time"}) + "</tr>", rows) +
         fmt::format(
             "<p>{}</p>\n<p>Floor of the flights: {}, the rounding of positions grown with the "
             "linear flow to the last time; misses below it say nothing. The jet's own chief is {} "
             "from the one that was flown then.</p>\n",
             !residual.empty()
                 ? fmt::format(
                       "Residual of the Hamilton-Jacobi equation, relative to its terms: {}. "
                       "It proves the signs, the inversion and that Hamiltonian and "
                       "equations of motion agree, not the accuracy of the integration.",
                       residual)
                 : std::string("The residual of the Hamilton-Jacobi equation was not computed."),
             length_text(result.flight_floor_m), length_text(result.chief_error_m));
}

}  // namespace hamjet::io
