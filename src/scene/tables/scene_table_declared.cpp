#include <algorithm>
#include <stdexcept>

#include "scene_table.hpp"

// Reading keys according to their declarations.

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

bool TableReader::attempt(const std::function<void()>& part) const {
  try {
    part();
    return true;
  } catch (const AlreadySaid&) {
    return false;
  } catch (const Error& error) {
    if (errors_ == nullptr) throw;
    errors_->keep(error);
    return false;
  }
}

void TableReader::require(const std::vector<std::string_view>& keys) const {
  bool is_good = true;
  for (const std::string_view key : keys) {
    form_of(key);
    is_good = attempt([&] { read_declared(*description_->find(key)); }) && is_good;
  }
  if (!is_good) throw AlreadySaid();
}

void TableReader::read_declared(const SceneKey& key) const {
  using Type = ValueForm::Type;
  const ValueForm& form = key.form;
  const std::string_view name = key.name;
  // Where words tell the form, its reader may take fewer numbers.
  const bool has_count = form.count > 0 && form.words.empty();
  const auto least = [&] { return static_cast<std::int64_t>(form.least); };
  const auto most = [&] { return static_cast<std::int64_t>(form.most); };
  if (form.type == Type::boolean) {
    boolean(name);
  } else if (form.type == Type::text && form.is_array) {
    texts(name);
  } else if (form.type == Type::text && !form.choices.empty()) {
    choice(name, form.choices);
  } else if (form.type == Type::text) {
    text(name);
  } else if (form.type == Type::integer && form.is_array) {
    integers(name, least(), most());
  } else if (form.type == Type::integer) {
    integer_between(name, least(), most());
  } else if (form.is_array && has_count && form.is_positive) {
    positive_numbers(name, form.count);
  } else if (form.is_array && has_count) {
    numbers(name, form.count);
  } else if (form.is_array) {
    numbers(name);
  } else if (form.is_positive) {
    positive_number(name);
  } else if (form.has_range()) {
    number_between(name, form.least, form.most);
  } else {
    finite(required(name, "a finite number"), dotted(name), "a finite number");
  }
}

std::vector<std::string_view> TableReader::owners_of_keys() const {
  std::vector<std::string_view> owners;
  for (const SceneKey& key : description_->keys) {
    const auto* value = table_->get_as<std::string>(key.name);
    if (value != nullptr && !key.form.choices.empty()) owners.emplace_back(value->get());
  }
  return owners;
}

void TableReader::attempt_declared_keys(const std::vector<std::string_view>& owners) const {
  if (description_ == nullptr) return;
  const auto all_owners = joined<std::string_view>({owners, owners_of_keys()});
  const auto is_of_another = [&](const SceneKey& key) {
    return !key.owners.empty() &&
           std::none_of(all_owners.begin(), all_owners.end(),
                        [&](std::string_view owner) { return key.belongs_to(owner); });
  };
  KnownKeys known;
  for (const SceneKey& key : description_->keys) {
    (is_of_another(key) ? known.refused_by_caller : known.keys).push_back(key.name);
  }
  attempt([&] { check_keys(known); });
  for (const SceneKey& key : description_->keys) {
    if (is_of_another(key)) continue;
    const bool is_required = key.absence.meaning == Absence::Meaning::refused;
    if (errors_->has_about(head(key.name)) || (!has(key.name) && !is_required)) continue;
    // Only `hamjet stability` reads this table.
    if (key.form.table == &case_table()) continue;
    if (key.form.table != nullptr) {
      attempt([&] {
        for (const TableReader& below :
             key.form.is_array ? tables(key.name) : std::vector{table(key.name)}) {
          below.attempt_declared_keys(all_owners);
        }
      });
    } else if (!has(key.name) || key.form.words.empty()) {
      // A form with words may allow less, or more, than its type, range and choices say; its key is
      // not tried.
      attempt([&] { read_declared(key); });
    }
  }
}

}  // namespace hamjet::io
