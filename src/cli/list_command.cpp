#include "list_command.hpp"

#include <fmt/format.h>

#include "../scene/tables/key_reference.hpp"
#include "../studies/descriptions/method_description.hpp"
#include "../studies/descriptions/system_description.hpp"
#include "../sweep/sweep_tables.hpp"
#include "hamjet/detail/maps/generating_function_kind.hpp"
#include "standard_streams.hpp"

namespace hamjet::cli {
namespace {

std::string systems() {
  std::string text;
  for (const SystemDescription& system : all_systems()) {
    text += fmt::format("{:<19}  {}\n", system.name, system.help);
  }
  return text;
}

std::string integrators() {
  std::string text;
  for (const MethodDescription& method : all_methods()) {
    text += fmt::format("{:<11}  {}", method.name, method.help);
    if (!method.is_built()) {
      text += fmt::format("  NOT BUILT: configure with {}", method.build_option);
    }
    text += '\n';
  }
  return text;
}

std::string kinds() {
  std::string text =
      "A generating function takes one final and one initial variable of each pair (q, p):\n"
      "F1 (q, q0)   F2 (q, p0)   F3 (p, q0)   F4 (p, p0)   auto (the best conditioned of all)\n"
      "For an orbit, final choice, hyphen, initial choice for x, y, z (for another model as many "
      "letters as\ndegrees of freedom):\n";
  const auto all = all_kinds(3);
  for (std::size_t i = 0; i < all.size(); ++i) {
    text += all[i].name() + (i % 8 == 7 ? "\n" : "  ");
  }
  return text;
}

}  // namespace

int list(const std::string& what) {
  if (what == "systems") print(systems());
  if (what == "integrators") print(integrators());
  if (what == "kinds") print(kinds());
  if (what == "keys") print(io::key_reference(io::sweep_study_table()));
  return 0;
}

}  // namespace hamjet::cli
