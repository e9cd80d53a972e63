#include "moments_table.hpp"

#include <functional>

#include "../../formats/relative_frame_text.hpp"
#include "../../store/result_table.hpp"
#include "../formation/transfer_json.hpp"
#include "collision_table.hpp"
#include "domains_table.hpp"
#include "safety_table.hpp"
#include "uncertainty_view.hpp"

namespace hamjet::io {
namespace {

/// One component of one distribution.
struct MomentsRow {
  double time = 0;  ///< canonical
  std::string state = {};
  std::string polynomials = {};
  std::string told_in = {};
  StateComponent component = {};
  Eigen::Index index = 0;              ///< index of the component
  const Cumulants* moments = nullptr;  ///< null if there are no moments
  const std::vector<Cumulants>* by_order =
      nullptr;            ///< the moments of all orders; null for flown samples
  std::size_t order = 0;  ///< place in `by_order`, from 0
  const Cumulants* linear = nullptr;
  const FlownMoments* flown = nullptr;  ///< null of polynomials
};
using MomentsColumns = ResultTable<MomentsRow>;

bool has_moments(const MomentsRow& row) { return row.moments != nullptr; }
bool has_order(const MomentsRow& row) { return has_moments(row) && row.by_order != nullptr; }
bool has_scatter(const MomentsRow& row) { return row.flown != nullptr; }

double divergence_of(const MomentsRow& row) {
  return divergence_from_gaussian(*row.moments, *row.linear);
}

/// Adds a column of components, or of a distribution as a whole, whose cells are of that level.
template <class Has, class Value>
void add(MomentsColumns& table, Has has, const char* name, const char* meaning, Value value,
         std::size_t whole = 0) {
  TableColumn& column = table.add_if(has, name, "", meaning, value);
  if (whole == 0) return;
  column.level = whole;
  column.is_in_csv = false;
}

/// What `member` has of the row's component.
template <class Of, class Member>
auto of_component(const Of* MomentsRow::*of, Member member) {
  return [of, member](const MomentsRow& row) -> double {
    return std::invoke(member, *(row.*of))[row.index];
  };
}
template <class Member>
auto of_all(Member member) {
  return [member](const MomentsRow& row) { return std::invoke(member, *row.moments); };
}

/// How many components the states of a result have.
Eigen::Index components_of(const UncertaintyResult& result) {
  return static_cast<Eigen::Index>(state_components(result).size());
}

/// The moments of `size` components.
void add_moments(MomentsColumns& table, std::size_t whole, Eigen::Index size) {
  const auto of = [](auto member) { return of_component(&MomentsRow::moments, member); };
  add(table, has_moments, "mean", "the mean, in the component's unit", of(&Cumulants::mean));
  add(table, has_moments, "standard_deviation", "the standard deviation, in the component's unit",
      of(&Cumulants::standard_deviations));
  const auto m = static_cast<std::size_t>(size);
  TableColumn& covariance = table.add_array(
      "covariance", std::vector<std::string>(m * m), "", "the covariance of all components",
      [](const MomentsRow& row) -> std::optional<std::vector<double>> {
        if (!has_moments(row)) return std::nullopt;
        const Matrix<double> matrix = row.moments->covariance().transpose();
        return std::vector(matrix.data(), matrix.data() + matrix.size());
      });
  covariance.level = whole;
  covariance.is_in_csv = false;
  covariance.lengths = {m, m};
  add(table, has_moments, "skewness", "the skewness of the component alone; 0 for a Gaussian one",
      of(&Cumulants::skewness));
  add(table, has_moments, "excess_kurtosis",
      "the excess kurtosis of the component alone; 0 for a Gaussian one",
      of(&Cumulants::excess_kurtosis));
  add(table, has_moments, "rank", "the rank of the covariance", of_all(&Cumulants::rank), whole);
  add(table, has_moments, "mardia_skewness",
      "the skewness of all components together, after Mardia (1970)",
      of_all(&Cumulants::mardia_skewness), whole);
  add(table, has_moments, "mardia_excess_kurtosis",
      "the excess kurtosis of all components together, after Mardia (1970); 0 for a Gaussian "
      "distribution",
      of_all(&Cumulants::mardia_excess_kurtosis), whole);
  add(table, has_moments, "negentropy",
      "how far the distribution is from a Gaussian one, in nats; its leading terms alone where it "
      "is not sure",
      of_all(&Cumulants::negentropy), whole);
}

/// Adds the columns that compare the distribution of an order with those of other orders.
void add_orders(MomentsColumns& table, std::size_t whole) {
  add(
      table, has_order, "negentropy_is_sure",
      "whether the negentropy is more than its leading terms, and nearly that of the order beside "
      "it",
      [](const MomentsRow& row) { return is_negentropy_sure(*row.by_order, row.order); }, whole);
  add(table, has_order, "divergence_from_linear",
      "the divergence of the distribution from the linear theory's Gaussian one, in nats",
      divergence_of, whole);
  add(
      table, has_order, "probability_error_of_linear",
      "the largest error of a probability by the linear theory's distribution",
      [](const MomentsRow& row) { return largest_error_of_probability(divergence_of(row)); },
      whole);
}

/// What moments of samples scatter by.
void add_scatter(MomentsColumns& table) {
  const auto of = [](auto member) { return of_component(&MomentsRow::flown, member); };
  add(table, has_scatter, "mean_scatter", "the standard deviation of the mean of so many samples",
      of(&FlownMoments::mean_error));
  add(table, has_scatter, "standard_deviation_scatter",
      "the standard deviation of the standard deviation of so many samples",
      of(&FlownMoments::deviation_error));
  add(table, has_scatter, "skewness_scatter",
      "the standard deviation of the skewness of so many samples",
      of(&FlownMoments::skewness_error));
  add(table, has_scatter, "excess_kurtosis_scatter",
      "the standard deviation of the excess kurtosis of so many samples",
      of(&FlownMoments::kurtosis_error));
}

void add_time(MomentsColumns& table, const UncertaintyResult& result) {
  const double unit = result.scene.units.time_s;
  TableColumn& time = table.add("time_s", "s", "since the start",
                                [=](const MomentsRow& row) { return row.time * unit; });
  time.level = 1;
  time.is_in_json = false;
}

/// Whose distribution a row of the file is about.
void add_keys(MomentsColumns& table, const UncertaintyResult& result) {
  const auto add = [&](const char* name, const char* meaning, auto value) -> TableColumn& {
    TableColumn& column = table.add(name, "", meaning, value);
    column.is_in_json = false;
    return column;
  };
  add("time_canonical", "since the start, in the scene's canonical unit of time",
      [&](const MomentsRow& row) { return told_time(result.scene, row.time); })
      .level = 1;
  add_time(table, result);
  add("state", "\"chief\", \"deputy\" or \"relative\", the deputy less the chief",
      &MomentsRow::state)
      .level = 1;
  add("polynomials", "the coordinates of the polynomials; \"flown\" for samples that were flown",
      &MomentsRow::polynomials)
      .level = 1;
  add("told_in", "the frame or the coordinates that the components are in", &MomentsRow::told_in)
      .level = 1;
  TableColumn& order = table.add_if(has_order, "order", "", "the order of the polynomials",
                                    [](const MomentsRow& row) { return row.order + 1; });
  order.level = 1;
  add("component", "the component of the state",
      [](const MomentsRow& row) { return row.component.name; });
  add("unit", "the unit of the component; nothing where it is canonical",
      [](const MomentsRow& row) { return row.component.unit; });
}

void add_scalars(MomentsColumns& table, const UncertaintyResult& result) {
  const UncertaintySettings& settings = *result.scene.uncertainty;
  table.add_scalar("coordinates", "", "the coordinates that the scene asks for",
                   name_of(result.coordinates));
  table.add_scalar("frame", "", "the frame of the results", frame_name(settings.frame));
  table.add_scalar("derivatives", "",
                   "whether velocities are seen from the turning axes or from inertial ones",
                   derivatives_name(settings.frame));
  table.add_scalar("units", "", "the units of the components",
                   is_orbit(result.scene.system.model)
                       ? "m, m/s; in other coordinates canonical, by the chief's distance at the "
                         "start"
                       : "m, m/s");
  table.add_scalar("verdict", "", "the outcome in words", uncertainty_verdict(result));
  table.add_scalars("notes", "", "what to know beside the numbers", uncertainty_notes(result));
  table.add_scalar("misleading_probability", "",
                   "the error of a probability from which on the linear covariance misleads",
                   misleading_probability);
  table.add_scalar("samples", "", "the number of samples that were flown",
                   settings.samples < 2 ? 0 : settings.samples);
}

std::vector<MomentsRow> rows_of_file(const UncertaintyResult& result) {
  std::vector<MomentsRow> rows;
  for (const UncertaintyAt& at : result.points) {
    for (const UncertainState& state : at.states) {
      const auto add = [&](MomentsRow row, const std::vector<StateComponent>& components) {
        for (const StateComponent& component : components) {
          row.component = component;
          rows.push_back(row);
          ++row.index;
        }
      };
      const auto families = moments_families(result, at, state);
      for (const MomentsFamily& family : families) {
        for (std::size_t n = 0; n < family.by_order->size(); ++n) {
          add({at.time,
               state.name,
               family.polynomials,
               family.told_in,
               {},
               0,
               &(*family.by_order)[n],
               family.by_order,
               n,
               family.linear},
              family.components);
        }
      }
      if (!state.flown) continue;
      MomentsRow row{at.time, state.name, "flown", families.front().told_in};
      row.moments = &state.flown->cumulants;
      row.flown = &*state.flown;
      add(row, families.front().components);
    }
  }
  return rows;
}

/// The moments of one family along times, states and orders.
TableView moments_of(const UncertaintyResult& result, const char* name, const char* meaning,
                     std::vector<Cumulants> UncertainState::*family) {
  const std::size_t states = result.points.front().states.size();
  const auto orders = static_cast<std::size_t>(result.scene.order);
  MomentsColumns table(name, "", {"times", "states", "orders", "components"}, meaning);
  add_time(table, result);
  const Eigen::Index size = components_of(result);
  add_moments(table, 3, size);
  add_orders(table, 3);
  std::vector<MomentsRow> rows;
  for (const UncertaintyAt& at : result.points) {
    for (const UncertainState& state : at.states) {
      const std::vector<Cumulants>& by_order = state.*family;
      for (std::size_t n = 0; n < orders; ++n) {
        MomentsRow row{at.time};
        if (!by_order.empty()) {
          row.moments = &by_order[n];
          row.by_order = &by_order;
          row.order = n;
          row.linear = &by_order.front();
        }
        for (; row.index < size; ++row.index) rows.push_back(row);
      }
    }
  }
  return std::move(table).view(
      rows, {result.points.size(), states, orders, static_cast<std::size_t>(size)});
}

TableView flown_moments_of(const UncertaintyResult& result) {
  MomentsColumns table("flown", "", {"times", "states", "components"},
                       "Moments of samples that were flown, in the frame of the results.");
  add_time(table, result);
  const Eigen::Index size = components_of(result);
  add_moments(table, 2, size);
  add_scatter(table);
  std::vector<MomentsRow> rows;
  for (const UncertaintyAt& at : result.points) {
    for (const UncertainState& state : at.states) {
      MomentsRow row{at.time};
      row.flown = state.flown ? &*state.flown : nullptr;
      row.moments = state.flown ? &state.flown->cumulants : nullptr;
      for (; row.index < size; ++row.index) rows.push_back(row);
    }
  }
  return std::move(table).view(rows, {result.points.size(), result.points.front().states.size(),
                                      static_cast<std::size_t>(size)});
}

/// The same table for Python alone.
TableView in_python_alone(TableView table) {
  for (TableColumn& column : table.columns) column.is_in_csv = column.is_in_json = false;
  return table;
}

}  // namespace

TableView moments_table(const UncertaintyResult& result) {
  MomentsColumns table("moments", "", {"distributions", "components"},
                       "Moments of deviations from the chief's nominal; in summary.json at "
                       "`/times/.../states/.../families/.../orders` and `.../flown`.");
  table.leave_rows_out_of_json();
  add_scalars(table, result);
  add_keys(table, result);
  const Eigen::Index size = components_of(result);
  add_moments(table, 1, size);
  add_orders(table, 1);
  add_scatter(table);
  const std::vector<MomentsRow> rows = rows_of_file(result);
  const auto count = static_cast<std::size_t>(size);
  return std::move(table).view(rows, {rows.size() / count, count});
}

TableView moments_of_polynomials(const Cumulants& moments) {
  MomentsColumns table("polynomials", "", {"distributions", "components"},
                       "Moments of polynomials.");
  add_moments(table, 1, moments.size());
  std::vector<MomentsRow> rows;
  MomentsRow row;
  row.moments = &moments;
  for (; row.index < moments.size(); ++row.index) rows.push_back(row);
  return std::move(table).view(rows, {1, rows.size()});
}

std::vector<TableView> uncertainty_tables(const UncertaintyResult& result) {
  std::vector<TableView> tables = {
      moments_table(result),
      in_python_alone(moments_of(result, "cartesian",
                                 "Moments by polynomials of positions and velocities, in the frame "
                                 "of the results.",
                                 &UncertainState::cartesian)),
      in_python_alone(moments_of(result, "charted",
                                 "Moments of the scene's other coordinates, canonical; nothing "
                                 "without such.",
                                 &UncertainState::charted)),
      in_python_alone(moments_of(result, "split",
                                 "Moments by polynomials of the scene's domains, in the frame of "
                                 "the results; nothing without such.",
                                 &UncertainState::split)),
      in_python_alone(flown_moments_of(result))};
  if (!result.domains.empty()) tables.push_back(domains_table(result));
  if (result.collision) {
    for (TableView& table : collision_tables(*result.collision)) {
      tables.push_back(std::move(table));
    }
  }
  if (result.safety) tables.push_back(safety_table(*result.safety));
  return tables;
}

}  // namespace hamjet::io
