#include <fmt/format.h>

#include <algorithm>

#include "hamjet/error.hpp"
#include "key_unit.hpp"
#include "scene_table.hpp"

// Which keys a table may have, and the messages about other keys.

namespace hamjet::io {
namespace {

bool contains(const std::vector<std::string_view>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Whether an unknown name may be a misspelling of this key: it lacks the unit, has one too many,
/// or has another one. The key is then not reported as missing.
bool may_stand_for(std::string_view name, std::string_view key) {
  const auto stem = [](std::string_view text) { return text.substr(0, text.rfind('_')); };
  return key.starts_with(name) || name.starts_with(key) || stem(name) == stem(key) ||
         nearest(name, {key}).has_value();
}

/// What an unknown key should have been: one of these keys, in another unit or nearly so spelt, or
/// a key of another table.
std::string remedy_for(std::string_view name, const std::vector<std::string_view>& keys) {
  for (const std::string_view key : keys) {
    const bool is_other_unit =
        !unit_of(name).empty() && !unit_of(key).empty() && without_unit(name) == without_unit(key);
    if (is_other_unit) return fmt::format("must be {}, in {}", key, unit_of(key));
  }
  if (!nearest(name, keys)) {
    const std::vector<std::string> paths = paths_of_key(name);
    constexpr std::size_t few = 4;
    if (paths.size() == 1) {
      const bool is_at_top = paths.front().find('.') == std::string::npos;
      return fmt::format("must be {}{}", paths.front(),
                         is_at_top ? " at the top of the scene, before any table" : "");
    }
    if (!paths.empty() && paths.size() <= few) {
      return fmt::format("must be one of: {}", fmt::join(paths, ", "));
    }
  }
  return suggestion(name, keys);
}

}  // namespace

std::vector<std::string> TableReader::keys() const {
  std::vector<const toml::key*> all;
  for (const auto& [key, node] : *table_) all.push_back(&key);
  std::stable_sort(all.begin(), all.end(), [](const toml::key* a, const toml::key* b) {
    return a->source().begin < b->source().begin;
  });
  std::vector<std::string> names;
  for (const toml::key* key : all) names.emplace_back(key->str());
  return names;
}

void TableReader::check_keys(const KnownKeys& known) const {
  for (const SceneSource::AbsentKey& absent : source_->absent_keys) {
    const std::vector<std::string_view> names =
        joined<std::string_view>({known.keys, known.keys_elsewhere});
    if (absent.table != path_ || contains(names, absent.name)) continue;
    if (errors_ != nullptr && errors_->has_about(absent.override_name)) throw AlreadySaid();
    throw Error(ErrorKind::usage,
                fmt::format("{}: nothing to remove, got no key {}; {}", absent.override_name,
                            in_quotes(absent.name), suggestion(absent.name, known.keys)));
  }
  std::vector<const toml::key*> unknown;
  for (const auto& [key, node] : *table_) {
    const bool is_known = contains(known.keys, key) || contains(known.refused_by_caller, key);
    if (!is_known) unknown.push_back(&key);
  }
  std::stable_sort(unknown.begin(), unknown.end(), [](const toml::key* a, const toml::key* b) {
    return a->source().begin < b->source().begin;
  });
  bool is_good = true;
  for (const toml::key* key : unknown) {
    is_good = attempt([&] { fail_unknown(*key, known); }) && is_good;
  }
  if (!is_good) throw AlreadySaid();
}

void TableReader::excuse_for(std::string_view unknown, const KnownKeys& known) const {
  const bool is_of_another = contains(known.keys_elsewhere, unknown);
  if (is_of_another || remedy_for_foreign_key(path_, unknown)) errors_->excuse_all_keys(path_);
  bool stands_for_one = false;
  for (const std::string_view key : known.keys) {
    if (has(key) || !may_stand_for(unknown, key)) continue;
    errors_->excuse_key(path_, key);
    stands_for_one = true;
  }
  if (!stands_for_one) errors_->excuse_any_key(path_);
}

void TableReader::fail_unknown(const toml::key& unknown, const KnownKeys& known) const {
  const std::string_view name = unknown.str();
  const auto& source = unknown.source();
  const std::string place =
      location(source.path ? *source.path : source_->name, source.begin.line, source.begin.column);
  const std::string head = message_head(*source_, place, dotted(name));
  const bool is_said =
      errors_ != nullptr && (errors_->has_about(head) || errors_->has_about(this->head(name)));
  if (is_said) throw AlreadySaid();
  if (errors_ != nullptr) excuse_for(name, known);
  if (contains(known.keys_elsewhere, name)) {
    throw_scene_error(head, fmt::format("{} has no key {}, must be one of: {}", known.owner, name,
                                        listed(known.keys)));
  }
  // An override's key may already end with the name.
  const std::string got = place.ends_with(name) ? "" : fmt::format("got {}, ", printable(name));
  const auto remedy = remedy_for_foreign_key(path_, name);
  throw_scene_error(head,
                    fmt::format("unknown key, {}{}", got,
                                remedy ? std::string(*remedy) : remedy_for(name, known.keys)));
}

}  // namespace hamjet::io
