#include "list_command.hpp"

#include <fmt/format.h>

#include <vector>

#include "../report/declared_tables.hpp"
#include "../scene/tables/key_reference.hpp"
#include "../studies/descriptions/method_description.hpp"
#include "../studies/descriptions/system_description.hpp"
#include "../sweep/sweep_tables.hpp"
#include "../text/terminal_text.hpp"
#include "hamjet/detail/maps/generating_function_kind.hpp"
#include "process/standard_streams.hpp"

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
    text += fmt::format("{:<16} ", method.name);
    if (!method.is_built()) {
      text += fmt::format("NOT BUILT: configure with {}; ", method.build_option);
    }
    text += fmt::format("{}\n", method.help);
  }
  return text;
}

std::string kinds() {
  std::string text =
      "Generating functions take one final, one initial variable of each pair (q, p):\n"
      "F1 (q, q0), F2 (q, p0), F3 (p, q0), F4 (p, p0), auto (the best of all).\n"
      "For an orbit, final choice, hyphen, initial choice for x, y, z (for another model as many "
      "letters as degrees of freedom):\n";
  const auto all = all_kinds(3);
  for (std::size_t i = 0; i < all.size(); ++i) {
    text += all[i].name() + (i % 8 == 7 ? "\n" : "  ");
  }
  return text;
}

/// What can be listed.
struct Topic {
  const char* name;
  const char* heading;  ///< in the list of everything; of Markdown, for the keys are a page of that
  std::string (*text)();
  bool is_page =
      false;  ///< whether it is a page of Markdown, which is not fitted to the terminal's width
};

const std::vector<Topic>& topics() {
  static const std::vector<Topic> all = {
      {"systems", "# Systems\n\n", systems},
      {"integrators", "# Integrators\n\n", integrators},
      {"kinds", "# Kinds of generating functions\n\n", kinds},
      {"keys", "", [] { return io::key_reference(io::sweep_study_table()); }, true},
      {"columns", "", io::columns_page, true}};
  return all;
}

}  // namespace

CLI::App* add_list_command(CLI::App& app, std::optional<std::string>& what) {
  std::vector<std::string> names;
  for (const Topic& topic : topics()) names.emplace_back(topic.name);
  CLI::App* command =
      app.add_subcommand("list", "list systems, integrators, kinds, keys and columns");
  command
      ->add_option("what", what,
                   "systems, integrators, kinds, or, as pages in Markdown, the keys of a scene and "
                   "the columns of results (default: all, one after the other)")
      ->check(CLI::IsMember(names));
  return command;
}

int list(const std::optional<std::string>& what) {
  std::string text;
  for (const Topic& topic : topics()) {
    if (what && *what != topic.name) continue;
    if (!what) text += (text.empty() ? "" : "\n") + std::string(topic.heading);
    text += topic.is_page ? topic.text() : io::fitted(topic.text());
  }
  print(text);
  return 0;
}

}  // namespace hamjet::cli
