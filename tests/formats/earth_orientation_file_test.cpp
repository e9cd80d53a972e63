#include "hamjet/formats/earth_orientation_file.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "../scene/scene_samples.hpp"
#include "hamjet/error.hpp"

// Tables of the IERS in the format finals2000A. The rows are facts of the IERS, typed from its
// file.

namespace hamjet::io {
namespace {

/// Columns 1 to 185 of a day: what Bulletins A and B have of it.
struct Row {
  std::string date = "10 718 55395.00";
  std::string pole_a = "I  0.106508 0.000071  0.481769 0.000050";
  std::string ut1_a = "I-0.0545765 0.0000116  0.1290 0.0089";
  std::string offset_a = "I    -0.157    0.196    -0.033    0.252";
  std::string pole_b = "  0.106448  0.481812";
  std::string ut1_b = " -0.0545963";
  std::string offset_b = "    -0.109     0.156";

  std::string text() const {
    return date + " " + pole_a + "  " + ut1_a + "  " + offset_a + pole_b + ut1_b + offset_b +
           "  \n";
  }
};

const Row second = {"10 719 55396.00",
                    "I  0.109388 0.000070  0.480572 0.000050",
                    "I-0.0546280 0.0000114 -0.0642 0.0089",
                    "I    -0.154    0.196    -0.010    0.252",
                    "  0.109425  0.480629",
                    " -0.0546413",
                    "    -0.137     0.293"};

Instant instant(const char* utc) { return instant_of(parse_epoch(utc).value(), TimeSystem::utc); }

EarthOrientation::Values values_at(const EarthOrientation& table, const char* midnight) {
  return table.between(instant(midnight), instant(midnight), 0)[0].values;
}

constexpr double arcsec = 4.84813681109536e-6;

TEST(EarthOrientationFile, RowsOfTheIersAreRead) {
  ASSERT_EQ(Row().text().size(), 188U);
  const EarthOrientation table = read_earth_orientation("finals", Row().text() + second.text());
  EXPECT_EQ(table.dates(), "2010-07-18 to 2010-07-19");
  EXPECT_FALSE(table.first_prediction());
  // Bulletin B comes before A; TAI - UTC was 34 s.
  const EarthOrientation::Values values = values_at(table, "2010-07-18T00:00:00");
  EXPECT_NEAR(values.ut1_minus_tt_s, -0.0545963 - 34 - 32.184, 1e-13);
  EXPECT_NEAR(values.pole_x, 0.106448 * arcsec, 1e-18);
  EXPECT_NEAR(values.pole_y, 0.481812 * arcsec, 1e-18);
  EXPECT_NEAR(values.offset_x, -0.109e-3 * arcsec, 1e-20);
  EXPECT_NEAR(values.offset_y, 0.156e-3 * arcsec, 1e-20);
}

TEST(EarthOrientationFile, BulletinAStandsInForB) {
  Row predicted = second;
  predicted.pole_b = predicted.ut1_b = predicted.offset_b = "";
  predicted.ut1_a[0] = 'P';
  // Lines may end where their values do.
  const EarthOrientation table = read_earth_orientation("finals", Row().text() + predicted.text());
  const EarthOrientation::Values values = values_at(table, "2010-07-19T00:00:00");
  EXPECT_NEAR(values.ut1_minus_tt_s, -0.0546280 - 34 - 32.184, 1e-13);
  EXPECT_NEAR(values.pole_x, 0.109388 * arcsec, 1e-18);
  EXPECT_NEAR(values.offset_y, -0.010e-3 * arcsec, 1e-20);
  EXPECT_EQ(table.first_prediction(), std::chrono::sys_days(std::chrono::year(2010) / 7 / 19));
  // Days without values end the file.
  const EarthOrientation same =
      read_earth_orientation("finals", Row().text() + second.text() + "10 720 55397.00\r\n\n");
  EXPECT_EQ(same.dates(), "2010-07-18 to 2010-07-19");
}

TEST(EarthOrientationFile, OtherTextIsRefusedWithItsLine) {
  const auto refused = [](const std::string& text, const std::vector<std::string>& words) {
    expect_error([&] { read_earth_orientation("finals", text); }, ErrorKind::input_output, words,
                 text);
  };
  const std::string first = Row().text();
  Row row = second;
  row.date = "10 719 55397.00";
  refused(first + row.text(), {"finals:2: another day than its date, got \"10 719\" and MJD 55397, "
                               "must be 100720 for it"});
  row = second;
  row.ut1_b = " -0.05x6413";
  refused(first + row.text(),
          {"finals:2: columns 155 to 165: got \" -0.05x6413\", must be UT1 - UTC"});
  row = second;
  row.pole_b = "109.425000  0.480629";
  refused(first + row.text(), {"finals:2: columns 135 to 144: got \"109.425000\"", "at most 2"});
  row = second;
  row.ut1_a = std::string(row.ut1_a.size(), ' ');
  row.ut1_b = std::string(row.ut1_b.size(), ' ');
  refused(first + row.text(), {"finals:2: a day that lacks UT1 - UTC or polar motion"});
  row = second;
  row.date = "591231 36933.00";
  refused(row.text(), {"finals:1: no day of the format finals2000A", "from 36934 on"});
  refused(second.text() + first, {"finals:2: days out of order, got 2010-07-18 after 2010-07-19"});
  refused(first, {"finals: no Earth orientation, got 1 days, must be two or more in succession"});
  refused("", {"finals: no Earth orientation, got 0 days"});
  refused("<?xml version=\"1.0\"?>\n", {"finals:1:"});
  refused("# MJD x y\n55395 0.1 0.4\n", {"finals:1: ", "must be a modified Julian date"});
  for (std::size_t length = 0; length < first.size(); length += 3) {
    EXPECT_THROW(read_earth_orientation("finals", first.substr(0, length)), Error) << length;
  }
}

}  // namespace
}  // namespace hamjet::io
