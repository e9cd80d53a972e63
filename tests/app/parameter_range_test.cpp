#include "app/parameter_range.hpp"

#include <gtest/gtest.h>

// Points at which a parameter of a jet deviates by more than its value, by hand.

namespace hamjet::cli {
namespace {

/// A jet in x, px and three parameters, of which one is 0.
io::StoredJet jet_in_parameters() {
  io::StoredJet jet;
  jet.model = SystemModel::own;
  jet.own_names = {"x", "px", "k", "density_factor", "thrust"};
  jet.parameters = 3;
  jet.nominal_initial = {1, 0, -0.02, 1, 0};
  jet.variables = {0, 1, 2, 3, 4};
  return jet;
}

TEST(ParameterRange, NamesTheParameterThatIsFurthestBeyondItsValue) {
  ParameterRange range(jet_in_parameters());
  EXPECT_FALSE(range.warning());
  // States and a parameter of 0 have no limit; a parameter may deviate by its own value.
  range.look(std::vector<double>{50, -9, 0.02, -1, 7});
  EXPECT_FALSE(range.warning());
  range.look(std::vector<double>{0, 0, 0.03, 0.5, 0});
  range.look(std::vector<double>{0, 0, 0, -4, 0});
  const std::string warning = range.warning().value();
  EXPECT_EQ(warning.find("warning: density_factor: far from its value of 1, got a deviation of -4 "
                         "(2 of 3 points beyond), should be up to 1"),
            0U)
      << warning;
}

}  // namespace
}  // namespace hamjet::cli
