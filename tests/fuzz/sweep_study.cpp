#include "sweep/sweep_study.hpp"

#include <algorithm>
#include <set>

#include "fuzz_target.hpp"

// Target: the study of a sweep. What is read has sizes that fit, and the manifest that is frozen of
// it brings the same study back.

namespace hamjet::fuzz {
namespace {

/// A million items, which a study may have, would take the memory and the time of thousands of
/// executions.
constexpr std::size_t most_items = 1000;

void check(const io::SweepStudy& study) {
  require(!study.items.empty() && study.items.size() <= most_items, "number of items");
  require(!study.columns.empty(), "no column");
  for (const auto& item : study.items) {
    require(item.size() == study.keys.size(), "an item with more or fewer values than keys");
  }
  std::set<std::string> names;
  for (const io::SweepKey& key : study.keys) {
    require(names.insert(key.name).second, "two keys of one name");
  }
  for (const io::SweepColumn& column : study.columns) {
    require(names.insert(column.name).second, "two columns of one name");
  }
  if (study.map) {
    require(study.map->x < study.keys.size() && study.map->y < study.keys.size() &&
                study.map->value < study.columns.size(),
            "map");
  }
  const std::size_t last = study.items.size() - 1;
  require(io::sweep_overrides(study, last).size() <= study.constants.size() + study.keys.size(),
          "overrides");
  (void)io::sweep_item_text(study, last);
  const std::string manifest = io::sweep_manifest(study);
  require(io::sweep_manifest(io::parse_sweep_manifest(manifest, "manifest.json")) == manifest,
          "a manifest that does not come back");
}

}  // namespace
}  // namespace hamjet::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hamjet;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  fuzz::is_read(
      [&] {
        fuzz::check(io::parse_sweep_study(
            text, "study.toml", [](const std::filesystem::path&) { return "schema = 1\n"; },
            fuzz::most_items));
      },
      {{ErrorKind::scene, ErrorKind::too_large}, {"study.toml"}});
  return 0;
}
