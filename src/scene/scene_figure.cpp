#include <fmt/format.h>

#include "../text/scene_message.hpp"
#include "scene_sections.hpp"

namespace hamjet::io {

const TableDescription& figure_table() {
  static const TableDescription table = {{{"quantity", form::choice({"exactness", "energy-error"}),
                                           absent::refused(), "drawn along time"},
                                          {"kind",
                                           form::words("a kind but `\"auto\"`"),
                                           absent::value("F1"),
                                           "kind of the generating function",
                                           {"exactness"}}}};
  return table;
}

FigureSettings read_figure(const TableReader& figure, const Scene& scene) {
  figure.check_keys();
  FigureSettings settings;
  settings.quantity = static_cast<FigureQuantity>(figure.choice("quantity"));
  if (settings.quantity == FigureQuantity::energy_error) {
    figure.check_keys("energy-error", "the quantity energy-error");
    return settings;
  }
  const std::size_t n = degrees_of_freedom_of_kinds(figure, "quantity", scene);
  settings.kind = figure.has("kind") ? figure.text("kind") : "F1";
  if (settings.kind == "auto" || explicit_kind(settings.kind, n).empty()) {
    figure.fail("kind",
                fmt::format("unknown kind, got {}, must be F1, F2, F3, F4, or letters as in "
                            "{}; auto is chosen at the final time, and is none along time",
                            in_quotes(settings.kind), explicit_kind("F2", n)));
  }
  return settings;
}

}  // namespace hamjet::io
