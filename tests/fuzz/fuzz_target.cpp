#include "fuzz_target.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <nlohmann/json.hpp>

namespace hamjet::fuzz {
namespace {

constexpr std::size_t longest_message = 1000;

void check_line(const std::string& message, const Refusal& refusal) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  require(std::none_of(message.begin(), message.end(), is_control),
          "a message with a line break, a NUL or another control character");
  require(message.size() <= longest_message, "a message that is too long: " + message);
  require(std::any_of(refusal.beginnings.begin(), refusal.beginnings.end(),
                      [&](std::string_view beginning) { return message.starts_with(beginning); }),
          "a message that does not begin with its place: " + message);
  try {
    (void)nlohmann::json(message).dump();
  } catch (const nlohmann::json::type_error&) {
    report("a message that is not UTF-8");
  }
}

/// Errors that are printed together take one line each. A last line may count the errors that are
/// not printed, and warnings follow.
void check_message(const std::string& message, const Refusal& refusal) {
  std::size_t lines = 0;
  for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
    end = message.find('\n', begin);
    const std::string line = message.substr(begin, end - begin);
    constexpr std::string_view warning = "warning: ";
    if (lines > 0 && refusal.most_errors > 1 && line.starts_with(warning)) {
      check_line(line.substr(warning.size()), refusal);
      continue;
    }
    require(++lines <= refusal.most_errors + (refusal.most_errors > 1 ? 1 : 0),
            "a message of too many lines: " + message);
    if (lines <= refusal.most_errors) check_line(line, refusal);
  }
}

}  // namespace

void report(std::string_view what) {
  std::fprintf(stderr, "FINDING: %.*s\n", static_cast<int>(what.size()), what.data());
  std::abort();
}

bool is_read(const std::function<void()>& read, const Refusal& refusal) {
  try {
    read();
    return true;
  } catch (const Error& error) {
    require(
        std::find(refusal.kinds.begin(), refusal.kinds.end(), error.kind()) != refusal.kinds.end(),
        std::string("an error of the wrong kind: ") + error.what());
    check_message(error.what(), refusal);
  } catch (const std::exception& error) {
    report(std::string("an exception that is no hamjet::Error: ") + error.what());
  }
  return false;
}

void require_finite(const std::vector<double>& numbers, std::string_view what) {
  require(std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); }),
          std::string(what) + ": a number that is not finite");
}

void require_ascending(const std::vector<std::size_t>& indices, std::size_t count,
                       std::string_view what) {
  require(!indices.empty() && indices.back() < count,
          std::string(what) + ": empty or out of range");
  require(
      std::adjacent_find(indices.begin(), indices.end(), std::greater_equal<>()) == indices.end(),
      std::string(what) + ": not ascending");
}

}  // namespace hamjet::fuzz
