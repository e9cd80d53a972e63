#pragma once

#include <concepts>
#include <string_view>
#include <type_traits>

namespace hamjet {
namespace detail {

/// Calls `visit` with each of the comma-separated names and the member at the same place.
template <class Visit, class... Members>
void visit_named(std::string_view names, const Visit& visit, Members&... members) {
  const auto next_name = [&names] {
    names.remove_prefix(names.find_first_not_of(", "));
    const std::string_view name = names.substr(0, names.find(','));
    names.remove_prefix(name.size());
    return name;
  };
  (visit(next_name(), members), ...);
}

}  // namespace detail

/// Defines for_each_field(settings, visit), which calls visit(name, member) for every member of a
/// `Settings`, const or not, in the order of the structure. The list must name all members in that
/// order; if a name is missing, the structured binding does not compile.
#define HAMJET_FIELDS(Settings, ...)                          \
  template <class Given, class Visit>                         \
  requires std::same_as<std::remove_const_t<Given>, Settings> \
  void for_each_field(Given& settings, const Visit& visit) {  \
    auto& [__VA_ARGS__] = settings;                           \
    detail::visit_named(#__VA_ARGS__, visit, __VA_ARGS__);    \
  }

/// Settings for whose members for_each_field is defined.
template <class Settings>
concept HasFields = requires(Settings& settings) {
  for_each_field(settings, [](std::string_view, auto&) {});
};

}  // namespace hamjet
