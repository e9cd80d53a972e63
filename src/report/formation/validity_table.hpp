#pragma once

#include <nlohmann/json.hpp>

#include "../../store/table_view.hpp"
#include "hamjet/studies/validity.hpp"

namespace hamjet::io {

/// Of each time and order how far the polynomials reach, and what holds for the whole result.
TableView validity_table(const ValidityResult& result);
/// The domains that deputies were split into.
TableView split_domains_table(const ValidityResult& result);
inline std::vector<TableView> validity_tables(const ValidityResult& result) {
  if (!result.domains) return {validity_table(result)};
  return {validity_table(result), split_domains_table(result)};
}

/// What a validity study found, as a part of a summary.
nlohmann::ordered_json validity_json(const ValidityResult& result);
/// `summary.json` of a validity study.
nlohmann::ordered_json validity_report_json(const ValidityResult& result);

}  // namespace hamjet::io
