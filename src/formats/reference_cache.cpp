#include "reference_cache.hpp"

#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <nlohmann/json.hpp>

#include "../store/text_file.hpp"
#include "../store/whole_file.hpp"
#include "hamjet/error.hpp"
#include "number_table.hpp"

namespace hamjet::io {
namespace {

/// 36 significant digits bring back the same 113-bit number.
std::string text_of(const Extended& value) { return value.str(36, std::ios_base::scientific); }

std::string hash_of(const std::string& text) {
  boost::uuids::name_generator_sha1 generator(boost::uuids::ns::url());
  return boost::uuids::to_string(generator(text));
}

nlohmann::json json_of(const std::string& key, const ReferenceResult& reference) {
  nlohmann::json jet = nlohmann::json::array();
  for (const auto& component : reference.jet) {
    nlohmann::json numbers = nlohmann::json::array();
    for (const Extended& c : component.coefficients()) numbers.push_back(text_of(c));
    jet.push_back(std::move(numbers));
  }
  return {{"key", key},
          {"jet", std::move(jet)},
          {"uncertainty_by_degree", reference.uncertainty_by_degree},
          {"steps", reference.statistics.steps},
          {"wall_seconds", reference.statistics.wall_seconds},
          {"stages", reference.stages},
          {"tolerance", reference.tolerance}};
}

/// The reference in a cached file; throws unless everything is as it was written.
ReferenceResult reference_of(const nlohmann::json& json, const SpacePointer& space) {
  ReferenceResult result;
  for (const nlohmann::json& numbers : json.at("jet")) {
    std::vector<Extended> coefficients;
    for (const nlohmann::json& text : numbers) {
      const auto number = finite_extended_number(text.get<std::string>());
      if (!number) throw Error(ErrorKind::input_output, "a coefficient is not finite");
      coefficients.push_back(*number);
    }
    result.jet.emplace_back(space, std::move(coefficients));
  }
  result.uncertainty_by_degree = json.at("uncertainty_by_degree").get<std::vector<double>>();
  if (result.jet.empty() ||
      result.uncertainty_by_degree.size() != static_cast<std::size_t>(space->order()) + 1) {
    throw Error(ErrorKind::input_output, "the sizes do not fit");
  }
  result.statistics.steps = json.at("steps");
  result.statistics.wall_seconds = json.at("wall_seconds");
  result.stages = json.at("stages");
  result.tolerance = json.at("tolerance");
  return result;
}

}  // namespace

std::filesystem::path ReferenceCache::user_directory() {
  // An empty or relative XDG_CACHE_HOME is to be ignored (XDG Base Directory Specification).
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && std::filesystem::path(cache).is_absolute()) {
    return std::filesystem::path(cache) / "hamjet" / "references";
  }
  const char* home = std::getenv("HOME");
  if (home == nullptr || !std::filesystem::path(home).is_absolute()) return {};
  return std::filesystem::path(home) / ".cache" / "hamjet" / "references";
}

std::filesystem::path ReferenceCache::file_of(const std::string& key) const {
  return directory_ / (hash_of(key) + ".json");
}

std::optional<ReferenceResult> ReferenceCache::load(const std::string& key,
                                                    const SpacePointer& space) {
  if (directory_.empty()) return std::nullopt;
  try {
    const FileContent content = read_regular_file(file_of(key), largest_reference_bytes);
    if (!content.problem.empty()) return std::nullopt;
    nlohmann::json json = nlohmann::json::parse(content.text);
    const std::string hash = json.at("hash");
    json.erase("hash");
    if (hash_of(json.dump()) != hash || json.at("key") != key) return std::nullopt;
    return reference_of(json, space);
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

void ReferenceCache::save(const std::string& key, const ReferenceResult& reference) {
  if (directory_.empty()) return;
  try {
    nlohmann::json json = json_of(key, reference);
    json["hash"] = hash_of(json.dump());
    write_whole_file(file_of(key), json.dump());
  } catch (const Error&) {
    // The disk is full or read-only: the reference will be computed again next time.
  }
}

}  // namespace hamjet::io
