#include "scene_elements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "hamjet/dynamics/mean_elements.hpp"
#include "hamjet/error.hpp"

namespace hamjet::io {
namespace {

/// Size and shape of an orbit.
struct Ellipse {
  Extended a_km;
  Extended e;
};

/// A way to give size and shape of an orbit: the keys that are needed together, and the function
/// that reads them.
struct SizeForm {
  std::vector<std::string_view> keys;
  Ellipse (*read)(const TableReader& table, const SceneCentre& centre);
  std::string_view words = {};

  bool has(std::string_view key) const {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
  }
};

double read_eccentricity(const TableReader& table) {
  const double e = table.number("e");
  if (e < 0 || e >= 1) {
    table.fail("e", fmt::format("out of range, got {}, must be at least 0 and below 1 (other "
                                "orbits are given by position_km and velocity_km_s)",
                                table.found("e")));
  }
  return e;
}

/// The distance from the centre that belongs to a height.
Extended distance_km(const TableReader& table, std::string_view key, const SceneCentre& centre) {
  const double radius = centre.system.radius_km;
  if (!(radius > 0)) {
    table.fail(key, fmt::format("a height in a scene without a radius, got {}, must be a_km with "
                                "e, or beside system.radius_km, which the model zonal-gravity has "
                                "without J_n too",
                                table.found(key)));
  }
  const double height = table.number(key);
  if (!(height > -radius)) {
    table.fail(key, fmt::format("at the centre or beyond, got {}, must be above {}, for heights "
                                "are above system.radius_km = {}",
                                table.found(key), -radius, radius));
  }
  return Extended(radius) + height;
}

Ellipse of_semi_major_axis(const TableReader& table, const SceneCentre&) {
  return {table.number("a_km"), read_eccentricity(table)};
}

Ellipse of_heights(const TableReader& table, const SceneCentre& centre) {
  const Extended perigee = distance_km(table, "perigee_height_km", centre);
  const Extended apogee = distance_km(table, "apogee_height_km", centre);
  const Ellipse ellipse = {(perigee + apogee) / 2, (apogee - perigee) / (apogee + perigee)};
  // An apogee of 1e300 km would round to e = 1.
  if (!(ellipse.e >= 0 && ellipse.e < 1)) {
    table.fail(
        "apogee_height_km",
        fmt::format("{} for its perigee, got {}, must be at least perigee_height_km = {}{}",
                    ellipse.e < 0 ? "too low" : "too high", table.found("apogee_height_km"),
                    table.found("perigee_height_km"), ellipse.e < 0 ? "" : " and make e below 1"));
  }
  return ellipse;
}

Ellipse of_period(const TableReader& table, const SceneCentre& centre) {
  return {semi_major_axis_of_period_km(table.number("period_s"), centre.system.mu_km3_s2),
          read_eccentricity(table)};
}

Ellipse of_circle(const TableReader& table, const SceneCentre& centre) {
  return {distance_km(table, "height_km", centre), 0};
}

const std::vector<SizeForm>& size_forms() {
  static const std::vector<SizeForm> all = {{{"a_km", "e"}, of_semi_major_axis},
                                            {{"perigee_height_km", "apogee_height_km"}, of_heights},
                                            {{"period_s", "e"}, of_period},
                                            {{"height_km"}, of_circle, " of a circle"}};
  return all;
}

std::string listed_size_forms() {
  std::vector<std::string> texts;
  for (const SizeForm& form : size_forms()) {
    texts.push_back(fmt::format("{}{}", fmt::join(form.keys, " with "), form.words));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

/// The form that belongs to the first key of a size that the table has; e alone does not determine
/// a form.
const SizeForm& size_form_of(const TableReader& table) {
  for (const SizeForm& form : size_forms()) {
    for (const std::string_view key : form.keys) {
      if (key != "e" && table.has(key)) return form;
    }
  }
  table.fail("", fmt::format("no size of the orbit, got none of its keys, must be one of: {}",
                             listed_size_forms()));
}

/// Refuses keys that no form has together.
void require_one_form(const TableReader& table) {
  std::vector<std::string_view> given;
  for (const std::string_view key : joined<std::string_view>({size_keys(), {"e"}})) {
    if (table.has(key)) given.push_back(key);
  }
  const auto are_of_one_form = [](std::string_view one, std::string_view other) {
    return std::any_of(size_forms().begin(), size_forms().end(),
                       [&](const SizeForm& form) { return form.has(one) && form.has(other); });
  };
  std::string_view wrong;
  std::string problem;
  for (const std::string_view key : given) {
    std::vector<std::string_view> others = given;
    std::erase_if(others, [&](std::string_view other) { return are_of_one_form(key, other); });
    if (others.empty()) continue;
    const std::string removal = table.removal_of_others(key, others);
    if (!problem.empty() && removal.empty()) continue;
    wrong = removal.empty() ? others[0] : key;
    problem = fmt::format("size and shape given twice, got {} and {}, must be one of: {}{}", key,
                          others[0], listed_size_forms(), removal);
    if (!removal.empty()) break;
  }
  if (!problem.empty()) table.fail(wrong, problem);
}

Ellipse read_ellipse(const TableReader& table, const SceneCentre& centre) {
  const SizeForm& form = size_form_of(table);
  require_one_form(table);
  const std::string_view given = *std::find_if(
      form.keys.begin(), form.keys.end(), [&](std::string_view key) { return table.has(key); });
  bool is_good = true;
  for (const std::string_view key : form.keys) {
    const auto read_one = [&] {
      if (!table.has(key)) {
        table.fail(
            key, fmt::format("missing beside {}, must be one of: {}", given, listed_size_forms()));
      }
      table.require({key});
    };
    is_good = table.attempt(read_one) && is_good;
  }
  if (!is_good) throw AlreadySaid();
  return form.read(table, centre);
}

/// Reads the argument of perigee and the true anomaly into `elements`. The eccentricity is known,
/// unless an error was found in it.
void read_place(const TableReader& table, const std::optional<Ellipse>& ellipse,
                OsculatingElements& elements) {
  const bool is_circle = ellipse && ellipse->e == 0;
  const bool has_latitude = table.has("u_deg");
  bool is_good = true;
  if (!table.has("argp_deg") && (!has_latitude || (ellipse && !is_circle))) {
    is_good = table.attempt([&] {
      table.fail("argp_deg",
                 has_latitude
                     ? "missing beside u_deg, must be a number from -360 to 360; u_deg stands for "
                       "argp_deg too on a circle alone"
                     : "missing, must be a number from -360 to 360, or u_deg in place of it and "
                       "the anomaly on a circle");
    });
  }
  const std::string_view key = table.exactly_one_of(place_keys());
  table.require({key});
  if (!is_good) throw AlreadySaid();
  const Extended angle_deg = table.number(key);
  // On a circle without a perigee the argument of latitude counts from the node.
  if (table.has("argp_deg")) elements.argument_of_perigee_deg = table.number("argp_deg");
  if (!ellipse) return;
  if (key == "u_deg") {
    elements.true_anomaly_deg = angle_deg - elements.argument_of_perigee_deg;
  } else if (key == "ta_deg") {
    elements.true_anomaly_deg = angle_deg;
  } else {
    elements.true_anomaly_deg = true_anomaly_of_eccentric_deg(
        key == "ea_deg" ? angle_deg : eccentric_anomaly_of_mean_deg(angle_deg, ellipse->e),
        ellipse->e);
  }
}

/// The osculating state that belongs to mean elements.
CartesianState osculating_of_mean_elements(const TableReader& table, const SystemSettings& system,
                                           const CartesianState& mean) {
  if (system.J[2] == 0) {
    table.fail("elements",
               "mean elements in a field without J2, got \"mean\", must be \"osculating\", which "
               "are the same there");
  }
  try {
    const OblateBody body{system.mu_km3_s2, system.radius_km, system.J[2]};
    const CartesianState state = osculating_of_mean(mean, body);
    // The inverse exists only if J2 is small enough for the theory.
    mean_of_osculating(state, body);
    return state;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    table.fail("elements", fmt::format("no mean elements here, got \"mean\", must be "
                                       "\"osculating\": {}",
                                       error.what()));
  }
}

}  // namespace

const std::vector<std::string_view>& size_keys() {
  static const std::vector<std::string_view> keys = [] {
    std::vector<std::string_view> result;
    for (const SizeForm& form : size_forms()) {
      for (const std::string_view key : form.keys) {
        if (key != "e") result.push_back(key);
      }
    }
    return result;
  }();
  return keys;
}

const std::vector<std::string_view>& place_keys() {
  static const std::vector<std::string_view> keys = {"ta_deg", "ea_deg", "ma_deg", "u_deg"};
  return keys;
}

std::vector<SceneKey> element_keys(const std::vector<std::string_view>& owners) {
  const auto other_form = absent::other("another form");
  // Angles may go once around in either sense; a larger number is hardly an angle in degrees.
  const auto angle = form::between(-360, 360);
  return {
      {"a_km", form::positive(), other_form, "semi-major axis", owners},
      {"e", form::words("number from 0, below 1", form::number()), other_form, "eccentricity",
       owners},
      {"perigee_height_km", form::number(), other_form, "height of the perigee above `radius_km`",
       owners},
      {"apogee_height_km", form::number(), other_form, "height of the apogee above `radius_km`",
       owners},
      {"period_s", form::positive(), other_form, "period of a revolution: 2 pi sqrt(a^3/mu)",
       owners},
      {"height_km", form::number(), other_form, "height of a circular orbit above `radius_km`",
       owners},
      {"i_deg", form::between(0, 180), other_form, "inclination", owners},
      {"raan_deg", angle, other_form, "right ascension of the ascending node", owners},
      {"argp_deg", angle, other_form, "argument of perigee", owners},
      {"ta_deg", angle, other_form, "true anomaly", owners},
      {"ea_deg", angle, other_form, "eccentric anomaly", owners},
      {"ma_deg", angle, other_form, "mean anomaly", owners},
      {"u_deg", angle, other_form,
       "true argument of latitude, argument of perigee plus true anomaly", owners},
      {"elements", form::choice({"osculating", "mean"}), absent::value("osculating"),
       "what the elements are: `mean` without the periodic terms of Brouwer's first order in J2",
       owners}};
}

CartesianState read_elements(const TableReader& table, const SceneCentre& centre) {
  OsculatingElements elements;
  std::optional<Ellipse> ellipse;
  // All errors are reported together.
  bool is_good = table.attempt([&] { ellipse = read_ellipse(table, centre); });
  is_good = table.attempt([&] { table.require({"i_deg", "raan_deg"}); }) && is_good;
  is_good = table.attempt([&] { read_place(table, ellipse, elements); }) && is_good;
  if (!is_good) throw AlreadySaid();
  elements.semi_major_axis_km = ellipse->a_km;
  elements.eccentricity = ellipse->e;
  elements.inclination_deg = table.number("i_deg");
  elements.ascending_node_deg = table.number("raan_deg");
  const CartesianState state = state_from_elements(elements, centre.system.mu_km3_s2);
  const bool are_mean = table.has("elements") && table.choice("elements") == 1;
  return are_mean ? osculating_of_mean_elements(table, centre.system, state) : state;
}

}  // namespace hamjet::io
