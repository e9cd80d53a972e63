#include "formats/reference_cache.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "support/temporary_directory.hpp"

namespace hamjet::io {
namespace {

ReferenceResult some_reference(const SpacePointer& space) {
  ReferenceResult reference;
  for (int i = 0; i < 2; ++i) {
    reference.jet.emplace_back(space);
    for (std::size_t k = 0; k < space->size(); ++k) {
      // Numbers that need all 113 bits.
      reference.jet.back()[k] = Extended(i + 1) / Extended(3 + 7 * static_cast<int>(k));
    }
  }
  reference.uncertainty_by_degree = {1e-20, 3e-19, 0.1 + 0.2};
  reference.stages = 16;
  reference.tolerance = 1e-24;
  reference.statistics.steps = 27;
  return reference;
}

TEST(ReferenceCache, GivesBackTheSameBits) {
  const test::TemporaryDirectory directory;
  const auto space = SeriesSpace::create(2, 2);
  const ReferenceResult saved = some_reference(space);
  ReferenceCache cache(directory.path() / "cache");
  EXPECT_FALSE(cache.load("key", space));
  cache.save("key", saved);
  const auto loaded = cache.load("key", space);
  ASSERT_TRUE(loaded);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < space->size(); ++k) {
      EXPECT_EQ(loaded->jet[i][k], saved.jet[i][k]);
    }
  }
  EXPECT_EQ(loaded->uncertainty_by_degree, saved.uncertainty_by_degree);
  EXPECT_EQ(loaded->stages, 16);
  EXPECT_EQ(loaded->statistics.steps, 27);
  EXPECT_FALSE(cache.load("another key", space));
  // A key cannot be used for a space of another size.
  EXPECT_FALSE(cache.load("key", SeriesSpace::create(2, 3)));
}

TEST(ReferenceCache, TakesADamagedFileForMissing) {
  const test::TemporaryDirectory directory;
  const auto space = SeriesSpace::create(2, 2);
  ReferenceCache cache(directory.path());
  cache.save("key", some_reference(space));
  const auto file = std::filesystem::directory_iterator(directory.path())->path();
  // The test changes one digit of one coefficient.
  std::string text;
  std::getline(std::ifstream(file), text);
  const std::size_t place = text.find("33333");
  ASSERT_NE(place, std::string::npos);
  std::ofstream(file) << text.replace(place, 1, "4");
  EXPECT_FALSE(cache.load("key", space));
  cache.save("key", some_reference(space));
  EXPECT_TRUE(cache.load("key", space));
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  EXPECT_FALSE(cache.load("key", space));
  std::ofstream(file) << "{}";
  EXPECT_FALSE(cache.load("key", space));
}

TEST(ReferenceCache, KeepsNothingWhereItCannotWrite) {
  const auto space = SeriesSpace::create(2, 2);
  ReferenceCache cache("/dev/null/cache");
  EXPECT_NO_THROW(cache.save("key", some_reference(space)));
  EXPECT_FALSE(cache.load("key", space));
}

}  // namespace
}  // namespace hamjet::io
