#pragma once

#include <fmt/format.h>

#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "properties/property.hpp"

// Random valid scenes, as tables that can be printed in many ways.

namespace hamjet::test {

struct SceneValue {
  std::variant<double, int, std::string, std::vector<SceneValue>> value;
};

struct SceneTable {
  std::string header;  ///< without brackets; empty for the keys before the first table
  bool is_one_of_many = false;
  std::vector<std::pair<std::string, SceneValue>> entries;

  void add(const std::string& key, double number) { entries.push_back({key, {number}}); }
  void add(const std::string& key, int number) { entries.push_back({key, {number}}); }
  void add(const std::string& key, const char* text) {
    entries.push_back({key, {std::string(text)}});
  }
  template <class Item>
  void add(const std::string& key, const std::vector<Item>& items) {
    std::vector<SceneValue> values;
    for (const Item& item : items) values.push_back({item});
    entries.push_back({key, {values}});
  }
};

using SceneTables = std::vector<SceneTable>;

inline bool yes_or_no(const char* name) { return *whole_number(0, 1).as(name) == 1; }

inline double drawn(double lowest, double highest) { return *number(lowest, highest); }

inline SceneTable random_nominal(bool is_orbit) {
  SceneTable nominal{"nominal", false, {}};
  if (!is_orbit) {
    nominal.add("position_m", std::vector<double>{drawn(-2, 2)});
    nominal.add("momentum_kg_m_s", std::vector<double>{drawn(-2, 2)});
  } else if (yes_or_no("elements")) {
    nominal.add("a_km", drawn(7000, 42000));
    nominal.add("e", drawn(0, 0.9));
    nominal.add("i_deg", drawn(0, 180));
    for (const char* angle : {"raan_deg", "argp_deg", "ta_deg"}) {
      nominal.add(angle, drawn(-360, 360));
    }
  } else {
    nominal.add("position_km",
                std::vector<double>{drawn(6500, 9000), drawn(-9000, 9000), drawn(-9000, 9000)});
    nominal.add("velocity_km_s", std::vector<double>{drawn(-1, 1), drawn(5, 7), drawn(-1, 1)});
  }
  return nominal;
}

inline SceneTable random_integrator(int index) {
  SceneTable integrator{"integrator", true, {}};
  integrator.add("label", fmt::format("run-{}", index).c_str());
  switch (*whole_number(0, 3).as("method")) {
    case 0:
      integrator.add("method", "gauss");
      integrator.add("stages", *whole_number(1, 12));
      integrator.add("tolerance", drawn(1e-15, 1e-3));
      break;
    case 1:
      integrator.add("method", "velocity-verlet");
      integrator.add("order", 2 * *whole_number(1, 4));
      integrator.add("step_canonical", drawn(1e-3, 1));
      break;
    case 2:
      integrator.add("method", "newmark");
      integrator.add("beta", drawn(0, 0.5));
      integrator.add("step_s", drawn(1, 100));
      break;
    default:
      integrator.add("method", "fehlberg78");
      integrator.add("tolerance", drawn(1e-15, 1e-3));
      break;
  }
  if (yes_or_no("checks")) {
    integrator.add("require_relative_error", drawn(1e-12, 1e-2));
    integrator.add("require_symplecticity", drawn(1e-12, 1e-2));
  }
  return integrator;
}

inline SceneTables random_transfer() {
  SceneTable transfer{"transfer", false, {}};
  transfer.add("frame", "RTN");
  transfer.add("times_s", std::vector<double>{drawn(10, 20), drawn(20, 30), drawn(31, 1000)});
  transfer.add("tolerance_m", drawn(0.1, 10));
  SceneTable start{"transfer.start", false, {}};
  start.add("position_m", std::vector<double>{drawn(-1e3, 1e3), drawn(-1e3, 1e3), drawn(-1e3, 0)});
  SceneTable end = start;
  end.header = "transfer.end";
  end.add("velocity_m_s", std::vector<double>{drawn(-1, 1), drawn(-1, 1), drawn(-1, 1)});
  SceneTable validity{"validity", false, {}};
  validity.add("count", *whole_number(1, 20));
  validity.add("semi_axes", std::vector<double>{drawn(1, 2), drawn(1, 2), drawn(1, 2)});
  validity.add("samples", *whole_number(10, 100));
  return {transfer, start, end, validity};
}

inline SceneTables random_scene() {
  SceneTable root;
  root.add("schema", 1);
  root.add("title", "a random scene");
  const int model = *whole_number(0, 3).as("model");
  const bool is_orbit = model >= 2;
  SceneTable system{"system", false, {}};
  if (model == 0) {
    system.add("model", "double-well");
  } else if (model == 1) {
    system.add("model", "harmonic-oscillator");
    system.add("mass_kg", drawn(0.1, 10));
    system.add("stiffness_N_per_m", drawn(0.1, 1e6));
  } else {
    system.add("model", model == 2 ? "kepler" : "zonal-gravity");
    system.add("mu_km3_s2", drawn(1e5, 1e6));
    if (model == 3) {
      system.add("radius_km", drawn(1000, 7000));
      system.add("J2", drawn(-1e-2, 1e-2));
      system.add("J3", drawn(-1e-5, 1e-5));
      system.add("J7", drawn(-1e-6, 1e-6));
    }
  }
  SceneTable jet{"jet", false, {}};
  jet.add("order", *whole_number(1, 20));
  jet.add(yes_or_no("seconds") ? "duration_s" : "duration_canonical", drawn(-100, 100));
  SceneTables tables = {root, system, random_nominal(is_orbit), jet};
  const int count = *whole_number(1, 3).as("integrators");
  for (int i = 0; i < count; ++i) tables.push_back(random_integrator(i));
  SceneTable formation{"formation", false, {}};
  formation.add(is_orbit ? "separation_km" : "separation_m", drawn(0.1, 10));
  tables.push_back(formation);
  SceneTable kinds{"generating_function", false, {}};
  kinds.add("kinds", std::vector<std::string>{"F1", "F3", "auto"});
  tables.push_back(kinds);
  SceneTable reference{"reference", false, {}};
  reference.add("tolerance", drawn(1e-28, 1e-16));
  tables.push_back(reference);
  SceneTable compare{"compare", false, {}};
  compare.add("methods", std::vector<std::string>{"gauss", "newmark"});
  compare.add("stages", std::vector<int>{*whole_number(1, 12), *whole_number(1, 12)});
  compare.add("tolerances", std::vector<double>{drawn(1e-9, 1e-3), drawn(1e-12, 1e-9)});
  compare.add("time_budget_s", drawn(1, 1000));
  tables.push_back(compare);
  if (is_orbit && yes_or_no("transfer")) {
    for (const SceneTable& table : random_transfer()) tables.push_back(table);
  }
  return tables;
}

/// The style of a printed scene: for each value the number of a way to write it, from 0.
using Style = std::function<int(int ways)>;

inline std::string printed_number(double x, const Style& style) {
  switch (style(6)) {
    case 0:
      return fmt::format("{}", x);  // the shortest form; 3 for 3.0
    case 1:
      return fmt::format("{:.17g}", x);
    case 2:
      return fmt::format("{:+.30e}", x);
    case 3:
      return fmt::format("{:.20E}", x);
    case 4: {  // 1.2_3_4
      std::string text = fmt::format("{:.17e}", x);
      const std::size_t point = text.find('.');
      for (std::size_t i = text.find('e') - 1; i > point + 1; --i) text.insert(i, 1, '_');
      return text;
    }
    default: {  // shifted by 7 digits: the digits are exact, the exponent makes up for the shift
      const std::string text = fmt::format("{:.17e}", x);
      const std::size_t point = text.find('.');
      const std::size_t e = text.find('e');
      return text.substr(0, point) + text.substr(point + 1, 7) + "." +
             text.substr(point + 8, e - point - 8) +
             fmt::format("e{:+}", std::stoi(text.substr(e + 1)) - 7);
    }
  }
}

inline std::string printed_integer(int i, const Style& style) {
  switch (style(5)) {
    case 0:
      return fmt::format("{}", i);
    case 1:
      return fmt::format("{:+}", i);
    case 2:
      return fmt::format("0x{:x}", i);
    case 3:
      return fmt::format("0o{:o}", i);
    default:
      return fmt::format("0b{:b}", i);
  }
}

inline std::string printed_text(const std::string& text, const Style& style) {
  switch (style(4)) {
    case 0:
      return fmt::format("\"{}\"", text);
    case 1:
      return fmt::format("'{}'", text);
    case 2:
      return fmt::format("\"\"\"\n{}\"\"\"", text);
    default: {  // the first character as an escape
      return fmt::format("\"\\u{:04x}{}\"", static_cast<int>(text[0]), text.substr(1));
    }
  }
}

inline std::string printed(const SceneValue& value, const Style& style) {
  if (const auto* x = std::get_if<double>(&value.value)) return printed_number(*x, style);
  if (const auto* i = std::get_if<int>(&value.value)) return printed_integer(*i, style);
  if (const auto* text = std::get_if<std::string>(&value.value)) return printed_text(*text, style);
  const auto& items = std::get<std::vector<SceneValue>>(value.value);
  const bool is_tall = style(2) == 1;
  std::string text = "[";
  for (const SceneValue& item : items) {
    text += is_tall ? "\n  " : text.size() > 1 ? " " : "";
    text += printed(item, style);
    if (is_tall || &item != &items.back()) text += ",";
  }
  return text + (is_tall ? " # the last\n]" : "]");
}

inline std::string printed_key(const std::string& key, const Style& style) {
  switch (style(3)) {
    case 0:
      return key;
    case 1:
      return fmt::format("\"{}\"", key);
    default:
      return fmt::format("'{}'", key);
  }
}

/// The text of a scene.
inline std::string printed(const SceneTables& tables, const Style& style) {
  std::string text = style(2) == 1 ? "\xef\xbb\xbf# a byte order mark\n" : "";
  for (const SceneTable& table : tables) {
    if (!table.header.empty()) {
      text += (table.is_one_of_many ? "[[" : "[") + table.header +
              (table.is_one_of_many ? "]]\n" : "]\n");
    }
    for (const auto& [key, value] : table.entries) {
      text += printed_key(key, style);
      text += style(2) == 1 ? "=" : " = ";
      text += printed(value, style) + (style(2) == 1 ? "\t# a comment\n" : "\n");
    }
    if (style(2) == 1) text += "\n   \n";
  }
  return text;
}

/// The plainest style.
inline std::string printed(const SceneTables& tables) {
  return printed(tables, [](int) { return 0; });
}

}  // namespace hamjet::test
