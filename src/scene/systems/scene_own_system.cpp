#include "scene_own_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <regex>
#include <utility>

#include "../../studies/descriptions/system_description.hpp"
#include "../scene_sections.hpp"

namespace hamjet::io {
namespace {

/// The owner of keys of systems that the scene writes.
const std::vector<std::string_view>& own_model() {
  static const std::vector<std::string_view> owner = {description_of(SystemModel::own).name};
  return owner;
}

/// The entries of a table of texts and numbers.
std::vector<NamedText> read_named_texts(const TableReader& system, std::string_view key) {
  if (!system.has(key)) return {};
  const TableReader table = system.table(key);
  std::vector<NamedText> texts;
  for (const std::string& name : table.keys()) {
    if (const auto text = table.text_if_any(name)) {
      texts.push_back({name, *text});
    } else if (table.is_number(name)) {
      texts.push_back({name, fmt::format("{}", table.number(name))});
    } else {
      table.fail(name,
                 fmt::format("wrong type, got {}, must be a number or an expression as a string",
                             table.found(name)));
    }
  }
  return texts;
}

/// Throws about a part of the text of a system, see ExpressionTextError, at its key below
/// `[system]`.
[[noreturn]] void fail_in_text(const TableReader& system, const std::string& part,
                               const std::string& problem) {
  const std::size_t dot = part.find('.');
  if (dot == part.npos) system.fail(part, problem);
  system.table(part.substr(0, dot)).fail(part.substr(dot + 1), problem);
}

/// Reads a part of the text of a system; what is wrong in it is said about the key that it stands
/// in.
void attempt_text(const TableReader& system, const std::function<void()>& part) {
  try {
    part();
  } catch (const ExpressionTextError& error) {
    fail_in_text(system, error.part(), error.problem());
  }
}

/// Makes the parameters that `jet.variables` names a part of the state, in that order.
void add_state_parameters(const TableReader& root, SystemText& text) {
  if (!root.has("jet") || !root.table("jet").has("variables")) return;
  for (const std::string& name : root.table("jet").texts("variables")) {
    const auto& known = text.state_parameters;
    const auto is_it = [&](const NamedText& parameter) { return parameter.name == name; };
    const bool is_new = std::any_of(text.parameters.begin(), text.parameters.end(), is_it) &&
                        std::find(known.begin(), known.end(), name) == known.end();
    if (is_new && known.size() < most_state_parameters) text.state_parameters.push_back(name);
  }
}

void refuse_beside(const TableReader& system, std::string_view key, std::string_view other,
                   std::string_view right) {
  if (!system.has(key)) return;
  system.fail(key, fmt::format("beside {}, got {}, must be {}", other, system.found(key), right));
}

/// The expression of `[event]`, which uses definitions and parameters too; empty without one.
std::string expression_of_event(const TableReader& root) {
  if (!root.has("event")) return "";
  return root.table("event").text_if_any("expression").value_or("");
}

/// Whether a name stands in an expression.
bool has_word(const std::string& expression, const std::string& name) {
  return std::regex_search(expression, std::regex("\\b" + name + "\\b"));
}

}  // namespace

std::vector<SceneKey> own_keys() {
  ValueForm of_table;
  of_table.type = ValueForm::Type::table;
  const auto table_of = [&](std::string words) { return form::words(std::move(words), of_table); };
  const std::vector<std::string_view>& own = own_model();
  return {
      {"coordinates", form::array(form::text()), absent::other("`states`"),
       "names of the coordinates", own},
      {"momenta", form::array(form::text()), absent::other("`states`"),
       "names of the momenta, in the order of the coordinates", own},
      {"hamiltonian", form::text(), absent::other("`vector_field`"),
       "an expression, see [expressions](../expressions.md)", own},
      {"parameters", table_of("table of numbers, or of expressions of them"), absent::other("none"),
       "constants by name; those that `jet.variables` names are variables", own},
      {"definitions", table_of("table of expressions"), absent::other("none"),
       "expressions by name, in any order", own},
      {"states", form::array(form::text()), absent::other("`coordinates` and `momenta`"),
       "names of the variables of a vector field", own},
      {"vector_field", table_of("table of expressions"), absent::other("`hamiltonian`"),
       "the derivative of each state by the time", own}};
}

void read_own_system(const TableReader& root, SystemSettings& settings) {
  const TableReader system = root.table("system");
  SystemText text;
  if (system.exactly_one_of({"hamiltonian", "vector_field"}) == "hamiltonian") {
    refuse_beside(system, "states", "a hamiltonian", "coordinates and momenta");
    text.coordinates = system.texts("coordinates");
    text.momenta = system.texts("momenta");
    text.hamiltonian = system.text("hamiltonian");
  } else {
    for (const std::string_view key : {"coordinates", "momenta"}) {
      refuse_beside(system, key, "a vector_field", "states");
    }
    text.states = system.texts("states");
    text.vector_field = read_named_texts(system, "vector_field");
  }
  text.parameters = read_named_texts(system, "parameters");
  text.definitions = read_named_texts(system, "definitions");
  attempt_text(system, [&] { make_system("own", text); });
  add_state_parameters(root, text);
  if (!text.state_parameters.empty()) attempt_text(system, [&] { make_system("own", text); });
  settings.own_degrees_of_freedom = text.degrees_of_freedom();
  settings.own_names = text.variables();
  settings.own_text = std::move(text);
}

void set_own_system(const TableReader& root, Scene& scene) {
  if (!scene.system.own_text) return;
  const TableReader system = root.table("system");
  const SystemText& text = *scene.system.own_text;
  DynamicalSystem made = make_system("own", text);
  attempt_text(system, [&] { require_finite_at(text, made, scene.nominal); });
  const std::string in_event = expression_of_event(root);
  for (const auto& [part, what] : likely_mistakes(text, made)) {
    const std::size_t dot = part.find('.');
    if (dot != part.npos && has_word(in_event, part.substr(dot + 1))) continue;
    const std::string head = dot == part.npos
                                 ? system.head(part)
                                 : system.table(part.substr(0, dot)).head(part.substr(dot + 1));
    scene.warnings.push_back(fmt::format("{}{}: {}", warning_head, head, what));
  }
  scene.own_system = std::make_shared<const DynamicalSystem>(std::move(made));
}

}  // namespace hamjet::io
