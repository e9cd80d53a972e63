#include "scene_relative_motion.hpp"
#include "tables_of_studies.hpp"

namespace hamjet::io {
namespace {

const TableDescription& eval_table() {
  static const TableDescription table = {
      domain_keys(absent::value(DomainSettings{}.tolerance_m),
                  "deputies are split into domains until each one's estimate of the miss is below "
                  "it",
                  "no more are made; deputies that are not right by then are marked outside"),
      "Deputies of `hamjet eval scene.toml` beyond the reach of the polynomials about the chief "
      "have polynomials about centres of their own."};
  return table;
}

void read_eval(const TableReader& table, Scene& scene, const Nominal& /*nominal*/) {
  table.check_keys();
  require_relative_motion(table, scene);
  scene.eval = read_domains(table, scene, "deputies");
}

}  // namespace

TableOfStudy eval_of_scenes() {
  return {"eval", &eval_table, "one jet about the chief for all",
          "domains of deputies for `hamjet eval`", &read_eval};
}

}  // namespace hamjet::io
