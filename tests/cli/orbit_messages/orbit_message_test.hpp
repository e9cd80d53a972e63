#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "../command_test.hpp"
#include "formats/orbit_message_samples.hpp"

// Orbit messages in and out, as a user meets them. What is written is checked by a reader written
// from the standard in another language (check_oem.py); what is read comes from the standard and
// from another program.

namespace hamjet::test {

inline constexpr const char* python = "/usr/bin/python3";

inline constexpr const char* dated = R"([output]
formats = ["oem"]
[ephemeris]
epoch = "2026-02-28T23:59:50.5"
time_system = "TAI"
reference_frame = "TOD"
center_name = "EARTH"
object_name = "CHIEF"
)";

/// The first states of tests/samples/real/LEO_60s.oem in the repository bradsease/oem, commit
/// 3ab31b2: a low orbit from a program with a full force model, a state a minute.
inline constexpr const char* low_orbit = R"(CCSDS_OEM_VERS = 2.0

COMMENT Orbit data are consistent with planetary ephemeris DE-430

CREATION_DATE  = 2020-06-01T00:32:46
ORIGINATOR     = Test

META_START
OBJECT_NAME          = TEST_OBJ
OBJECT_ID            = 0000-000A
CENTER_NAME          = Earth
REF_FRAME            = ICRF
TIME_SYSTEM          = UTC
START_TIME           = 2020-06-01T12:00:00.000000
USEABLE_START_TIME   = 2020-06-01T12:00:00.000000
USEABLE_STOP_TIME    = 2020-06-01T13:00:00.000000
STOP_TIME            = 2020-06-01T13:00:00.000000
INTERPOLATION        = Lagrange
INTERPOLATION_DEGREE = 7
META_STOP

2020-06-01T12:00:00.000000  -4.706641952872011e+03  -2.918623186846944e+03   3.932995817738559e+03   6.077667602389965e-01  -6.470290930680426e+00  -4.059846290755485e+00
2020-06-01T12:01:00.000000  -4.659443185713036e+03  -3.299871874607716e+03   3.680574084331019e+03   9.649363656794152e-01  -6.233151071975111e+00  -4.351015833932221e+00
2020-06-01T12:02:00.000000  -4.590937743703589e+03  -3.666030848199918e+03   3.411273695970938e+03   1.317718313079672e+00  -5.967490649721602e+00  -4.622251514385893e+00
)";

/// A scene whose nominal starts from a message; `nominal` are the keys of its table.
inline std::string from_message(const std::string& nominal) {
  return "schema = 1\ntitle = \"from a message\"\n[system]\nmodel = \"zonal-gravity\"\n"
         "mu_km3_s2 = 398600.4415\nradius_km = 6378.1363\nJ2 = 1.08262668355315e-3\n[nominal]\n" +
         nominal +
         "[jet]\norder = 1\nduration_s = 60\n[[integrator]]\nlabel = \"gauss8\"\n"
         "method = \"gauss\"\ntolerance = 1e-13\n";
}

class OrbitMessages : public CommandTest {
 protected:
  OrbitMessages() {
    write("dated.toml", quick_scene() + dated);
    write("low.oem", low_orbit);
    write("standard.oem", io::standard_oem);
    write("standard.opm", io::standard_opm);
  }

  /// The states of a message as the independent reader prints them: object, seconds since the first
  /// epoch, six numbers.
  Table checked(const std::filesystem::path& message) const {
    const std::string checker =
        std::string(HAMJET_SOURCE_DIR) + "/tests/cli/orbit_messages/check_oem.py";
    const std::filesystem::path output = directory_ / "checked.csv";
    const std::string command = std::string(python) + " '" + checker + "' '" +
                                (directory_ / message).string() + "' >'" + output.string() + "'";
    EXPECT_EQ(std::system(command.c_str()), 0) << content(directory_ / message);
    return read_table(output);
  }
};

}  // namespace hamjet::test
