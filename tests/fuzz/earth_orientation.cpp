#include "fuzz_target.hpp"
#include "hamjet/formats/earth_orientation_file.hpp"

// Target: a table of the Earth's orientation in the format finals2000A.

namespace hamjet::fuzz {
namespace {

void check(const EarthOrientation& table) {
  require(!table.dates().empty() && table.dates().size() < 200, "dates");
  const Epoch first = parse_epoch(table.dates().substr(0, 10) + "T00:00:00").value();
  const Instant start = instant_of(first, TimeSystem::utc);
  const auto days = table.between(start, start, 3);
  require(days.size() >= 2 && days[0].start == start, "the first day");
  for (const EarthOrientation::Day& day : days) {
    const EarthOrientation::Values& v = day.values;
    require_finite({v.ut1_minus_tt_s, v.pole_x, v.pole_y, v.offset_x, v.offset_y}, "values");
  }
}

}  // namespace
}  // namespace hamjet::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hamjet;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  fuzz::is_read([&] { fuzz::check(io::read_earth_orientation("finals", text)); },
                {{ErrorKind::input_output}, {"finals:"}});
  return 0;
}
