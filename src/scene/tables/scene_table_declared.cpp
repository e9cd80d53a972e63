#include <stdexcept>

#include "scene_table.hpp"

// Reading by what is declared of a key.

namespace hamjet::io {

const ValueForm& TableReader::form_of(std::string_view key) const {
  const SceneKey* declared = description_ != nullptr ? description_->find(key) : nullptr;
  if (declared == nullptr) throw std::logic_error("not a declared key: " + dotted(key));
  return declared->form;
}

const TableDescription* TableReader::description_of(std::string_view key) const {
  const SceneKey* declared = description_ != nullptr ? description_->find(key) : nullptr;
  return declared != nullptr ? declared->form.table : nullptr;
}

std::int64_t TableReader::integer(std::string_view key) const {
  const ValueForm& form = form_of(key);
  return integer_between(key, static_cast<std::int64_t>(form.least),
                         static_cast<std::int64_t>(form.most));
}

std::vector<std::int64_t> TableReader::integers(std::string_view key) const {
  const ValueForm& form = form_of(key);
  return integers(key, static_cast<std::int64_t>(form.least), static_cast<std::int64_t>(form.most));
}

std::size_t TableReader::choice(std::string_view key) const {
  return choice(key, form_of(key).choices);
}

}  // namespace hamjet::io
