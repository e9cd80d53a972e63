#include "json_text.hpp"

#include <utility>

#include "../text/printable_text.hpp"
#include "json_values.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

/// Replaces numbers that are not finite by strings; nlohmann would write null.
void name_what_is_not_finite(Json& value) {
  if (value.is_structured()) {
    for (Json& element : value) name_what_is_not_finite(element);
  } else if (value.is_number_float()) {
    value = json_number(value.get<double>());
  }
}

}  // namespace

std::string json_text(Json value, int indent) {
  name_what_is_not_finite(value);
  return printable_json(value.dump(indent, ' ', false, Json::error_handler_t::replace));
}

}  // namespace hamjet::io
