#include "safety_table.hpp"

#include <array>
#include <functional>
#include <limits>

#include "../../store/result_table.hpp"

namespace hamjet::io {

bool is_in_doubt(const SafetyPair& pair) {
  return pair.margin && pair.margin->deviations.value_or(0) > 0 && !pair.margin->is_confirmed();
}

TableView safety_table(const SafetyResult& result) {
  using Row = const SafetyPair*;
  const SafetyWatch& watch = result.watch;
  ResultTable<Row> table("safety", "/safety", {"pairs"},
                         "How near every pair of a formation comes, with each share of the burn.");
  table.add_scalar("keep_apart_m", "m", "the separation to be kept", watch.keep_apart_m);
  table.add_scalars("window_s", "s", "the window of time that was looked at, after the start",
                    std::array{result.from_s, result.to_s});
  table.add_scalar("share", "", "the share of all cases that stay beyond `separation_m`",
                   watch.share);
  table.add_scalar("confidence", "", "the confidence of the intervals", watch.confidence);
  table.add_scalar("order", "", "the order of the polynomials", result.order);
  const Eigen::Vector3d none = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  table
      .add_scalars("keep_out_m", "m", "the semi-axes of the ellipsoid about the chief",
                   watch.keep_out_m.value_or(none))
      .is_in_json = watch.keep_out_m.has_value();
  table
      .add_scalar("least_separation_m", "m",
                  "the separation that the lower end of `separation_interval_m` must reach",
                  watch.least_separation_m)
      .is_in_json = watch.least_separation_m.has_value();
  table
      .add_scalar("least_deviations", "", "the least number that `keep_out_deviations` must be",
                  watch.least_deviations)
      .is_in_json = watch.least_deviations.has_value();

  const auto of_separations = [](auto member) {
    return [member](Row row) { return std::invoke(member, row->separations); };
  };
  table.add("first", "", "the first spacecraft of the pair", &SafetyPair::first);
  table.add("second", "", "the second spacecraft of the pair", &SafetyPair::second);
  table.add("burn_share", "",
            "the share of the burn that is done; nothing for a pair that does not burn",
            &SafetyPair::burn_share);
  table.add("mean_separation_m", "m", "the least separation of the means",
            &SafetyPair::mean_separation_m);
  table.add("separation_m", "m", "the least separation that the share of all cases keeps",
            [](Row row) { return row->separations.separations[0]; });
  table.add_array(
      "separation_interval_m", {"separation_lower_m", "separation_upper_m"}, "m",
      "the interval of that separation at the confidence; infinite above the largest sample",
      [](Row row) {
        return std::array{row->separations.lower[0], row->separations.upper[0]};
      });
  table
      .add("separation_error_m", "m",
           "by how much that separation may be wrong beside its sampling",
           [](Row row) { return row->separations.errors[0]; })
      .is_in_csv = false;
  table.add("samples", "", "the number of samples of the polynomials",
            of_separations(&LeastSeparations::samples));
  table.add("nearer", "", "the number of samples that come nearer than the separation to be kept",
            of_separations(&LeastSeparations::nearer));
  table
      .add("probability_nearer", "", "the share of the samples that come nearer",
           [](Row row) {
             return static_cast<double>(row->separations.nearer) /
                    static_cast<double>(row->separations.samples);
           })
      .is_in_csv = false;
  table.add_array("probability_nearer_interval", {"probability_lower", "probability_upper"}, "",
                  "the interval of that share at the confidence", [](Row row) {
                    return std::array{row->separations.lower_nearer, row->separations.upper_nearer};
                  });
  table
      .add("flights", "", "the number of samples that were flown with the full equations",
           of_separations(&LeastSeparations::flights))
      .is_in_csv = false;
  table.add("flight_difference_m", "m",
            "the largest difference between the least separations of these flights and those of "
            "the polynomials",
            of_separations(&LeastSeparations::flight_difference));

  const auto touches = [](Row row) { return row->margin && row->margin->deviations; };
  const auto add_margin = [&](const char* name, const char* unit, const char* meaning,
                              auto value) -> TableColumn& {
    TableColumn& column = table.add_if(touches, name, unit, meaning, value);
    column.is_in_json = watch.keep_out_m.has_value();
    return column;
  };
  add_margin("keep_out_deviations", "",
             "standard deviations up to which the ellipsoid about the chief stays free; nothing "
             "where it does up to any",
             [](Row row) { return *row->margin->deviations; });
  add_margin("keep_out_time_s", "s",
             "the time at which the shortest deviation touches the ellipsoid",
             [](Row row) { return row->margin->time; });
  add_margin("keep_out_flown_ratio", "",
             "how near the flight of that deviation comes to the ellipsoid, 1 at its surface",
             [](Row row) { return row->margin->flown_ratio; });
  add_margin("keep_out_in_doubt", "", "whether the flight of that deviation misses the surface",
             [](Row row) { return is_in_doubt(*row); })
      .is_in_csv = false;
  TableColumn& refusal = table.add("no_keep_out", "", "the reason why no such deviation was found",
                                   &SafetyPair::refusal);
  refusal.is_in_csv = false;
  refusal.is_in_json = watch.keep_out_m.has_value();
  std::vector<Row> rows;
  for (const SafetyPair& pair : result.pairs) rows.push_back(&pair);
  return std::move(table).view(rows, {rows.size()});
}

}  // namespace hamjet::io
