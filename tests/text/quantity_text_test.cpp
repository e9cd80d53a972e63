#include "text/quantity_text.hpp"

#include <gtest/gtest.h>

// Values for people: the expected text is what a person would write.

namespace hamjet {
namespace {

TEST(QuantityText, HasThreeDigitsAndAPrefix) {
  EXPECT_EQ(duration_text(0.0123), "12.3 ms");
  EXPECT_EQ(length_text(-45.6e-6), "-45.6 μm");
  EXPECT_EQ(length_text(999), "999 m");
  EXPECT_EQ(memory_text(1.2e6), "1.2 MB");
  EXPECT_EQ(length_text(0), "0 m");
  // The rounding of metres is printed, but not lengths of the size of atoms.
  EXPECT_EQ(length_text(2.65e-16), "2.65e-16 m");
}

// A value that rounds up to a thousand has the next prefix.
TEST(QuantityText, RoundsIntoTheNextPrefix) {
  EXPECT_EQ(length_text(0.9996), "1 m");
  EXPECT_EQ(duration_text(999.7e-6), "1 ms");
}

TEST(QuantityText, LengthsAreInKilometresFromOneOn) {
  EXPECT_EQ(length_text(4560), "4.56 km");
  EXPECT_EQ(length_text(1.65e6), "1650 km");
  EXPECT_EQ(length_text(-42164e3), "-42,200 km");
  EXPECT_EQ(length_text(6892900e3, 8), "6,892,900 km");
  EXPECT_EQ(length_text(384400e3, 6), "384,400 km");
  EXPECT_EQ(length_text(1e14), "100,000,000,000 km");
  EXPECT_EQ(length_text(999.7), "1 km");
}

TEST(QuantityText, OneOfSomethingIsSingular) {
  EXPECT_EQ(counted(1, "revolution"), "1 revolution");
  EXPECT_EQ(counted(0, "deputy"), "0 deputies");
  EXPECT_EQ(counted(2U, "slot"), "2 slots");
  EXPECT_EQ(counted("1", "revolution"), "1 revolution");
  EXPECT_EQ(counted("1.5", "revolution"), "1.5 revolutions");
}

}  // namespace
}  // namespace hamjet
