#include "formats/dace_text.hpp"

#include <bit>
#include <cmath>

#include "fuzz_target.hpp"

// Target: text of DACE, in the variables that it has itself, and as the two polynomials of order 3
// in 2 variables that a summary says. What is read and written again must come back bit by bit.

namespace hamjet::fuzz {
namespace {

constexpr const char* name = "jet.dace";

void check(const std::vector<Series<double>>& polynomials) {
  require(!polynomials.empty(), "no polynomial");
  std::vector<Series<Extended>> extended;
  for (const Series<double>& polynomial : polynomials) {
    auto& series = extended.emplace_back(polynomial.space_pointer());
    for (std::size_t k = 0; k < polynomial.size(); ++k) {
      require(std::isfinite(polynomial[k]), "a coefficient that is not finite");
      series[k] = Extended(polynomial[k]);
    }
  }
  const auto again =
      io::read_dace_text("again", io::dace_text(extended, {"note"}), extended[0].space_pointer());
  require(again.size() == polynomials.size(), "number of polynomials");
  for (std::size_t i = 0; i < again.size(); ++i) {
    for (std::size_t k = 0; k < again[i].size(); ++k) {
      require(std::bit_cast<std::uint64_t>(again[i][k]) ==
                  std::bit_cast<std::uint64_t>(polynomials[i][k]),
              "coefficients that do not come back");
    }
  }
}

}  // namespace
}  // namespace hamjet::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hamjet;
  static const SpacePointer space = SeriesSpace::create(2, 3);
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  fuzz::is_read([&] { fuzz::check(io::read_dace_text(fuzz::name, text, space)); },
                {{ErrorKind::input_output}, {"jet.dace:"}});
  fuzz::is_read([&] { fuzz::check(io::read_dace_text(fuzz::name, text)); },
                {{ErrorKind::input_output, ErrorKind::too_large}, {"jet.dace:"}});
  return 0;
}
