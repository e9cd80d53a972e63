#include "scene_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

namespace hamjet::io {
namespace {

using Place = std::pair<std::size_t, std::size_t>;

std::string dotted(std::string_view table, std::string_view key) {
  return fmt::format("{}.{}", table, key);
}

/// The line and column with which the message begins, after the source's name.
Place place_of(std::string_view message, std::string_view source) {
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  Place place(none, none);
  if (!message.starts_with(source)) return place;
  const char* at = message.data() + source.size();
  const char* const end = message.data() + message.size();
  for (std::size_t* number : {&place.first, &place.second}) {
    if (at == end || *at != ':') return {none, none};
    const auto [rest, error] = std::from_chars(at + 1, end, *number);
    if (error != std::errc()) return {none, none};
    at = rest;
  }
  return place;
}

}  // namespace

void SceneErrors::keep(const Error& handled) {
  const std::string message = handled.what();
  const bool is_kept = std::any_of(kept_.begin(), kept_.end(),
                                   [&](const Kept& other) { return other.message == message; });
  if (!is_kept) kept_.push_back({message, handled.kind(), std::current_exception()});
}

void SceneErrors::warn(const std::string& line) {
  if (std::find(warnings_.begin(), warnings_.end(), line) == warnings_.end()) {
    warnings_.push_back(line);
  }
}

bool SceneErrors::has_about(std::string_view head) const {
  return std::any_of(kept_.begin(), kept_.end(), [&](const Kept& kept) {
    const std::string_view message = kept.message;
    return message.starts_with(head) && message.substr(head.size()).starts_with(": ");
  });
}

void SceneErrors::excuse_key(std::string_view table, std::string_view key) {
  excused_keys_.insert(dotted(table, key));
}

bool SceneErrors::is_excused(std::string_view table, std::string_view key) const {
  return excused_tables_.contains(table) || excused_keys_.contains(dotted(table, key));
}

bool SceneErrors::take_excuse(std::string_view table, std::string_view key) {
  if (is_excused(table, key)) return true;
  const auto left = excuses_left_.find(table);
  if (left == excuses_left_.end() || left->second == 0) return false;
  --left->second;
  excuse_key(table, key);
  return true;
}

void SceneErrors::raise(std::string_view source, const std::vector<std::string>& warnings) const {
  const bool is_alone =
      kept_.size() == 1 && (warnings.empty() || kept_[0].kind != ErrorKind::scene);
  if (is_alone) std::rethrow_exception(kept_[0].thrown);
  std::vector<std::pair<Place, const Kept*>> placed;
  for (const Kept& kept : kept_) placed.emplace_back(place_of(kept.message, source), &kept);
  std::stable_sort(placed.begin(), placed.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string_view> lines;
  for (const auto& [place, kept] : placed) lines.emplace_back(kept->message);
  std::string more;
  if (lines.size() > most_errors_said) {
    more = fmt::format("\nand {} more", lines.size() - most_errors_said);
    lines.resize(most_errors_said);
  }
  for (const std::string& warning : warnings) more += "\n" + warning;
  const bool is_of_scene = std::any_of(
      kept_.begin(), kept_.end(), [](const Kept& kept) { return kept.kind == ErrorKind::scene; });
  throw Error(is_of_scene ? ErrorKind::scene : kept_[0].kind,
              fmt::format("{}{}", fmt::join(lines, "\n"), more));
}

}  // namespace hamjet::io
