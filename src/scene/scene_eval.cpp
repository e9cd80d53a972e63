#include "scene_relative_motion.hpp"
#include "tables_of_studies.hpp"

namespace hamjet::io {
namespace {

const TableDescription& eval_table() {
  constexpr int most = 10000;
  static const EvalSettings preset;
  static const TableDescription table = {
      {{"tolerance_m", form::positive(), absent::value(preset.tolerance_m),
        "deputies are split into domains until each one's estimate of the miss is below it"},
       {"most_domains", form::integer(1, most), absent::value(preset.most_domains),
        "no more are made; deputies that are not right by then are marked outside"}},
      "Deputies of `hamjet eval scene.toml` beyond the reach of the polynomials about the chief "
      "have polynomials about centres of their own."};
  return table;
}

void read_eval(const TableReader& table, Scene& scene, const Nominal& /*nominal*/) {
  table.check_keys();
  require_relative_motion(table, scene);
  if (scene.order < 2) {
    table.fail("",
               "no estimate of the miss to split deputies by, got jet.order = 1, must be beside an "
               "order of 2 or more");
  }
  EvalSettings settings;
  table.read_if_any("tolerance_m", settings.tolerance_m);
  table.read_if_any("most_domains", settings.most_domains);
  scene.eval = settings;
}

}  // namespace

TableOfStudy eval_of_scenes() {
  return {"eval", &eval_table, "one jet about the chief for all",
          "domains of deputies for `hamjet eval`", &read_eval};
}

}  // namespace hamjet::io
