#include "hamjet/dynamics/expression_text.hpp"

#include <string>
#include <string_view>

#include "fuzz_target.hpp"

// Target: expressions. Lines `name = expression` are definitions, the last line is the function.
// What is read is written as text again, which must be read as the same list.

namespace hamjet::fuzz {
namespace {

/// More operations than any system has; writing them takes its time.
constexpr std::size_t most_operations = 2000;

FunctionText function_of(std::string_view text) {
  FunctionText function;
  function.variables = {"x", "y", "px"};
  function.parameters = {{"mu", "1/81.3"}};
  while (true) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    const std::size_t equals = line.find('=');
    if (end == text.npos || equals == line.npos) break;
    const std::string_view name = line.substr(0, line.find_last_not_of(' ', equals - 1) + 1);
    function.definitions.push_back({std::string(name), std::string(line.substr(equals + 1))});
    text.remove_prefix(end + 1);
  }
  function.outputs = {{"hamiltonian", std::string(text)}};
  return function;
}

void check(const FunctionText& function) {
  const OperationList list = record_function(function);
  if (list.operations().size() > most_operations) return;
  const FunctionText printed = print_list(list, function.variables, {"hamiltonian"});
  require(is_same_list(record_function(printed), list), "a list that does not come back");
  static_cast<void>(unused_names(function));
}

}  // namespace
}  // namespace hamjet::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hamjet;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  fuzz::is_read([&] { fuzz::check(fuzz::function_of(text)); },
                {{ErrorKind::usage}, {"hamiltonian: ", "definitions.", "parameters."}});
  return 0;
}
