#include <algorithm>
#include <cmath>

#include "hamjet/error.hpp"
#include "hamjet/scene/scene_reader.hpp"
#include "properties/random_scene.hpp"
#include "support/random_series.hpp"

// A scene that is written in another way is the same scene; a misspelt word is named in the error.

namespace hamjet::io {
namespace {

/// The whole contents of a scene, with numbers to the last bit.
std::string all_of(const Scene& scene) {
  std::string text;
  const auto add_text = [&](std::string_view part) { text += fmt::format("{};", part); };
  const auto add = [&](double number) { text += fmt::format("{:a};", number); };
  const auto add_optional = [&](const std::optional<double>& number) {
    number ? add(*number) : add_text("none");
  };
  const auto add_all = [&](const auto& numbers) {
    for (const auto number : numbers) add(static_cast<double>(number));
    add_text("|");
  };
  add_text(scene.title);
  for (const double x :
       {scene.system.mu_km3_s2, scene.system.radius_km, scene.system.mass_kg,
        scene.system.stiffness_N_per_m, scene.units.length_km, scene.units.time_s,
        scene.canonical_radius, scene.duration, static_cast<double>(scene.system.model),
        static_cast<double>(scene.order)}) {
    add(x);
  }
  for (int n = 2; n <= 20; ++n) add(scene.system.J[n]);
  add_all(scene.nominal);
  add_all(scene.variables);
  for (const IntegratorSettings& integrator : scene.integrators) {
    add_text(integrator.label);
    add_all(std::vector<double>{static_cast<double>(integrator.method),
                                static_cast<double>(integrator.stages),
                                static_cast<double>(integrator.order), integrator.beta});
    add_optional(integrator.step_canonical);
    add_optional(integrator.tolerance);
    add_optional(integrator.require_relative_error);
    add_optional(integrator.require_symplecticity);
  }
  add_optional(scene.separation);
  for (const std::string& kind : *scene.kinds) add_text(kind);
  add(scene.reference->tolerance);
  add_all(scene.comparison.stages);
  add_all(scene.comparison.tolerances);
  add(static_cast<double>(scene.comparison.methods.size()));
  add(scene.comparison.time_budget_s);
  if (scene.transfer) {
    add_all(scene.transfer->times);
    add_all(scene.transfer->start.position_m);
    add_all(scene.transfer->end.position_m);
    add_all(scene.transfer->end.velocity_m_s);
    add(scene.transfer->tolerance_m);
    add_all(scene.validity->times);
    add_all(scene.validity->semi_axes);
    add(scene.validity->samples);
  }
  return text;
}

TEST(SceneTexts, WrittenInAnotherWayItIsTheSame) {
  test::expect_property(
      [] {
        const test::SceneTables tables = test::random_scene();
        const std::string expected = all_of(parse_scene(test::printed(tables), "scene.toml"));
        for (int i = 0; i < 5; ++i) {
          test::RandomNumbers random(
              static_cast<unsigned>(*test::whole_number(0, 1 << 30).as("style")));
          std::string text =
              test::printed(tables, [&](int ways) { return random.integer(0, ways - 1); });
          RC_LOG() << text;
          RC_ASSERT(all_of(parse_scene(text, "scene.toml")) == expected);
          // Line ends of Windows.
          for (std::size_t end = text.find('\n'); end != text.npos;
               end = text.find('\n', end + 2)) {
            text.insert(end, 1, '\r');
          }
          RC_ASSERT(all_of(parse_scene(text, "scene.toml")) == expected);
        }
      },
      200);
}

// Tables and the keys of integrators may stand in any order; integrators keep theirs.
TEST(SceneTexts, TheOrderOfTablesAndKeysDoesNotMatter) {
  test::expect_property(
      [] {
        test::SceneTables tables = test::random_scene();
        const std::string expected = all_of(parse_scene(test::printed(tables), "scene.toml"));
        for (auto& table : tables) std::reverse(table.entries.begin(), table.entries.end());
        std::stable_partition(tables.begin() + 1, tables.end(),
                              [](const auto& table) { return table.header == "integrator"; });
        RC_ASSERT(all_of(parse_scene(test::printed(tables), "scene.toml")) == expected);
      },
      50);
}

/// A word with a typing mistake.
std::string misspelt(std::string word) {
  const auto place = static_cast<std::size_t>(
      *test::whole_number(0, static_cast<int>(word.size()) - 1).as("place of the mistake"));
  switch (*test::whole_number(0, 3).as("mistake")) {
    case 0:
      word.erase(place, 1);
      break;
    case 1:
      word.insert(place, 1, word[place]);
      break;
    case 2:
      if (place + 1 < word.size()) std::swap(word[place], word[place + 1]);
      break;
    default:
      word[place] = 'x';
      break;
  }
  return word;
}

void require_named(const test::SceneTables& tables, const std::string& name) {
  const std::string text = test::printed(tables);
  RC_LOG() << text;
  try {
    parse_scene(text, "scene.toml");
  } catch (const Error& error) {
    const std::string message = error.what();
    RC_LOG() << message;
    RC_ASSERT(error.kind() == ErrorKind::scene);
    RC_ASSERT(message.starts_with("scene.toml:"));
    // Some words are keys of other models or methods.
    RC_ASSERT(message.find("unknown key, got " + name) != message.npos ||
              message.find("has no key " + name) != message.npos);
    return;
  }
  RC_FAIL("the misspelt name is accepted: " + name);
}

TEST(SceneTexts, AMisspeltKeyIsNamed) {
  test::expect_property(
      [] {
        test::SceneTables tables = test::random_scene();
        auto& table = tables[static_cast<std::size_t>(
            *test::whole_number(0, static_cast<int>(tables.size()) - 1).as("table"))];
        auto& key =
            table
                .entries[static_cast<std::size_t>(
                    *test::whole_number(0, static_cast<int>(table.entries.size()) - 1).as("entry"))]
                .first;
        const std::string name = misspelt(key);
        RC_PRE(name != key && !name.empty());
        key = name;
        require_named(tables, name);
      },
      500);
}

TEST(SceneTexts, AMisspeltTableIsNamed) {
  test::expect_property(
      [] {
        test::SceneTables tables = test::random_scene();
        auto& header =
            tables[static_cast<std::size_t>(
                       *test::whole_number(1, static_cast<int>(tables.size()) - 1).as("table"))]
                .header;
        const std::string right = header.substr(header.find('.') + 1);
        const std::string name = misspelt(right);
        RC_PRE(name != right && !name.empty());
        header.replace(header.size() - right.size(), right.size(), name);
        require_named(tables, name);
      },
      200);
}

// A file in other units of length and time, powers of two of km and s, is the same canonical scene.
TEST(SceneTexts, UnitsThatArePowersOfTwo) {
  test::expect_property(
      [] {
        const double mu = *test::number(4e5, 8e5).as("mu");
        const double x = *test::number(6500, 9000).as("x");
        const double z = *test::number(-3000, 3000).as("z");
        const double v = *test::number(5, 7).as("v");
        const int k = *test::whole_number(-40, 40).as("power of the length");
        const int m = *test::whole_number(-40, 40).as("power of the time");
        const auto scene = [&](int length, int time) {
          return parse_scene(
              fmt::format(
                  "schema = 1\ntitle = \"t\"\n[system]\nmodel = \"zonal-gravity\"\n"
                  "mu_km3_s2 = {}\nradius_km = {}\nJ2 = 1e-3\n[nominal]\n"
                  "position_km = [{}, 0, {}]\nvelocity_km_s = [0, {}, 0]\n[jet]\norder = 1\n"
                  "duration_orbits = 1.25\n[[integrator]]\nlabel = \"a\"\n"
                  "method = \"gauss\"\ntolerance = 1e-9\n",
                  std::ldexp(mu, 3 * length - 2 * time), std::ldexp(6378, length),
                  std::ldexp(x, length), std::ldexp(z, length), std::ldexp(v, length - time)),
              "scene.toml");
        };
        const Scene plain = scene(0, 0);
        const Scene scaled = scene(k, m);
        RC_ASSERT(scaled.nominal == plain.nominal);
        RC_ASSERT(scaled.duration == plain.duration);
        RC_ASSERT(scaled.canonical_radius == plain.canonical_radius);
        RC_ASSERT(scaled.units.length_km == std::ldexp(plain.units.length_km, k));
        RC_ASSERT(scaled.units.time_s == std::ldexp(plain.units.time_s, m));
      },
      100);
}

}  // namespace
}  // namespace hamjet::io
