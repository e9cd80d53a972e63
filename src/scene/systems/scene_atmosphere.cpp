#include "scene_atmosphere.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>

#include "../../dynamics/fields/density_profile.hpp"
#include "../../formats/number_table.hpp"
#include "../../store/text_file.hpp"
#include "../../text/scene_message.hpp"
#include "hamjet/error.hpp"

namespace hamjet::io {
namespace {

constexpr std::size_t largest_density_file_bytes = std::size_t{1} << 20;
/// The spline's equations are solved with many digits, in a time that grows with the square of the
/// number of heights.
constexpr std::size_t most_heights = 1000;
constexpr std::string_view right_table = "must be density_file, or heights_km and densities_kg_m3";

/// A table of densities and the key that gave it.
struct GivenTable {
  DensityTable table;
  std::string_view key;
};

DensityTable table_of_file(const TableReader& system) {
  constexpr std::string_view key = "density_file";
  const std::string text = system.content_beside_scene(key, largest_density_file_bytes);
  std::string_view rest = text;
  NumberTableReader reader(printable_path(system.path_beside_scene(key)),
                           {"height_km", "density_kg_m3"}, [&](std::span<char> to) {
                             const std::size_t count = std::min(to.size(), rest.size());
                             std::memcpy(to.data(), rest.data(), count);
                             rest.remove_prefix(count);
                             return count;
                           });
  DensityTable table;
  for (;;) {
    const NumberTable part = reader.read(most_heights);
    if (part.numbers.empty()) return table;
    for (std::size_t i = 0; i < part.rows(); ++i) {
      table.heights_km.push_back(part.row(i)[0]);
      table.densities.push_back(part.row(i)[1]);
    }
  }
}

GivenTable given_table(const TableReader& system) {
  const bool has_file = system.has("density_file");
  const bool has_heights = system.has("heights_km"), has_densities = system.has("densities_kg_m3");
  if (has_file) {
    for (const std::string_view key : {"heights_km", "densities_kg_m3"}) {
      if (!system.has(key)) continue;
      system.fail(key, fmt::format("given twice, got {} beside density_file, must be left out, or "
                                   "density_file",
                                   system.found(key)));
    }
    return {table_of_file(system), "density_file"};
  }
  if (!has_heights && !has_densities) {
    system.fail("atmosphere", fmt::format("no densities, got \"table\" alone, {}", right_table));
  }
  if (!has_heights || !has_densities) {
    const std::string_view there = has_heights ? "heights_km" : "densities_kg_m3";
    system.fail(there, fmt::format("half of a table, got {} alone, {}", there, right_table));
  }
  const std::vector<double> densities = system.numbers("densities_kg_m3");
  return {
      {system.numbers("heights_km"), system.positive_numbers("densities_kg_m3", densities.size())},
      "heights_km"};
}

/// What shows units other than km and kg/m^3: densities fall from 1.2 kg/m^3 at the ground to 6e-7
/// at 100 km, where all models agree within a factor of two, and to at most 1e-10 at 300 km.
void warn_of_units(const TableReader& system, const GivenTable& given) {
  const auto& [heights, densities] = given.table;
  constexpr double highest_km = 20000;
  if (heights.back() > highest_km) {
    system.warn(given.key, fmt::format("heights of no atmosphere, got up to {:.6g} km, should be "
                                       "below {} km; are they in metres?",
                                       heights.back(), highest_km));
    return;
  }
  const auto most_at = [](double height) {
    return height < 90 ? 2.0 : height < 150 ? 1e-5 : height < 300 ? 1e-8 : 1e-9;
  };
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const bool is_dense = densities[i] > most_at(heights[i]);
    const bool is_thin = densities[i] < 1e-22 && heights[i] < 1000;
    if (!is_dense && !is_thin) continue;
    system.warn(given.key,
                fmt::format("a density of no atmosphere, got {:.4g} kg/m^3 at {:.6g} km, should be "
                            "from {} to {}; are densities in g/km^3 or g/cm^3, or logarithms?",
                            densities[i], heights[i], 1e-22, most_at(heights[i])));
    return;
  }
}

/// Heights so far apart that the smooth curve between them is no atmosphere.
void warn_of_gaps(const TableReader& system, const GivenTable& given,
                  const DensityProfile& profile) {
  constexpr double largest = 0.3;
  const double departure = profile.largest_departure();
  if (departure <= largest) return;
  system.warn(given.key,
              fmt::format("heights too far apart, got densities that between them are up "
                          "to {:.3g} % off the exponentials that join the table's, "
                          "should be at most {:g} %: more heights in the wide gaps",
                          100 * departure, 100 * largest));
}

void read_table_of_densities(const TableReader& system, AtmosphereSettings& air) {
  const GivenTable given = given_table(system);
  if (given.table.heights_km.size() > most_heights) {
    system.fail(given.key, fmt::format("a table of {} heights, must be of at most {}",
                                       given.table.heights_km.size(), most_heights));
  }
  try {
    air.profile = std::make_shared<const DensityProfile>(given.table);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::usage) throw;
    system.fail(given.key, error.what());
  }
  warn_of_units(system, given);
  warn_of_gaps(system, given, *air.profile);
  air.heights_km = given.table.heights_km;
  air.densities_kg_m3 = given.table.densities;
  if (given.key == "density_file") air.density_file = system.text("density_file");
}

}  // namespace

void refuse_alone(const TableReader& table, std::initializer_list<std::string_view> keys,
                  std::string_view what, std::string_view other) {
  for (const std::string_view key : keys) {
    if (!table.has(key)) continue;
    table.fail(key, fmt::format("without {}, got {}, must be left out, or beside {}", what,
                                table.found(key), other));
  }
}

std::vector<SceneKey> atmosphere_keys() {
  const std::vector<std::string_view> owner = {"earth"};
  const AtmosphereSettings air;
  return {
      {"atmosphere", form::choice({atmosphere_names.begin(), atmosphere_names.end()}),
       absent::other("no drag"),
       "density of the air, which turns with the Earth: `harris-priester` bulges on the afternoon "
       "side, 100 to 1000 km high; `table` is one's own",
       owner},
      {"density_factor", form::positive(), absent::value(air.density_factor),
       "a factor of all densities of the air", owner},
      {"bulge_exponent", form::integer(2, 6), absent::value(air.bulge_exponent),
       "exponent of the bulge's cosine, even: 2 for low inclinations, 6 for polar orbits", owner},
      {"density_file", form::text(), absent::other("`heights_km`"),
       "file of the `table`, CSV with the columns `height_km` and `density_kg_m3`; its path is "
       "relative to the scene's folder",
       owner},
      {"heights_km", form::array(form::number()), absent::other("`density_file`"),
       "heights of the `table` above the ellipsoid, at least 4, increasing", owner},
      {"densities_kg_m3", form::array(form::positive()), absent::other("`density_file`"),
       "densities of the `table` at its heights; between them ln of the density is smooth", owner}};
}

/// The limits are far outside what the Sun does to the air, so that what they find is a slip: a
/// percentage, or a density.
void warn_of_factor(const TableReader& system, double factor) {
  constexpr double least = 0.02, most = 50;
  if (factor >= least && factor <= most) return;
  system.warn("density_factor",
              fmt::format("of no air of the Earth, got {:.6g}, should be from {} to {}: it is a "
                          "factor of the table's densities, near 1, no percentage",
                          factor, least, most));
}

void read_air(const TableReader& system, EarthSettings& earth) {
  if (!system.has("atmosphere")) {
    refuse_alone(
        system,
        {"density_factor", "bulge_exponent", "density_file", "heights_km", "densities_kg_m3"},
        "air", "atmosphere");
    return;
  }
  AtmosphereSettings air;
  air.model = static_cast<AtmosphereModel>(system.choice("atmosphere"));
  if (system.has("density_factor")) {
    air.density_factor = system.positive_number("density_factor");
    warn_of_factor(system, air.density_factor);
  }
  system.read_if_any("bulge_exponent", air.bulge_exponent);
  if (air.bulge_exponent % 2 != 0) {
    system.fail("bulge_exponent",
                fmt::format("odd, got {}, must be 2, 4 or 6", air.bulge_exponent));
  }
  if (air.model == AtmosphereModel::table) {
    read_table_of_densities(system, air);
  } else {
    refuse_alone(system, {"density_file", "heights_km", "densities_kg_m3"}, "a table",
                 "atmosphere = \"table\"");
  }
  earth.atmosphere = air;
}

}  // namespace hamjet::io
