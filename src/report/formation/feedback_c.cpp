#include <fmt/format.h>
#include <fmt/ranges.h>

#include "../../formats/relative_frame_text.hpp"
#include "feedback_errors_view.hpp"
#include "hamjet/version.hpp"
#include "transfer_view.hpp"

namespace hamjet::io {

std::string feedback_c_text(const TransferResult& result) {
  const FeedbackLaw& law = *result.thrust->feedback;
  const SeriesSpace& space = law.instants.front().thrust.front().space();
  const int order = law.instants.front().thrust.front().order();
  std::string text = fmt::format(
      "/* The thrust of least energy by polynomials of order {}; hamjet {}. C99 without\n"
      "   dependencies. States and thrust are along the axes of the frame {}. */\n\n"
      "enum {{ HAMJET_INSTANTS = {}, HAMJET_MONOMIALS = {} }};\n\n"
      "/* The instants and the arrival, in s since the start. */\n"
      "const double hamjet_time_s[HAMJET_INSTANTS + 1] = {{\n",
      order, version, frame_text(result.scene.transfer->frame), law.instants.size(), space.size());
  for (const FeedbackInstant& instant : law.instants) {
    text += fmt::format("  {:.17g},\n", seconds(result, instant.time));
  }
  text += fmt::format("  {:.17g}}};\n\nstatic const unsigned char powers[HAMJET_MONOMIALS][6] = {{",
                      seconds(result, result.thrust->transfers[*result.thrust->least].time));
  for (std::size_t m = 0; m < space.size(); ++m) {
    const auto exponents = space.exponents(m);
    text += fmt::format("{}\n  {{{}}}", m > 0 ? "," : "", fmt::join(exponents, ", "));
  }
  text += "};\n\nstatic const double coefficients[HAMJET_INSTANTS][HAMJET_MONOMIALS][3] = {";
  for (std::size_t k = 0; k < law.instants.size(); ++k) {
    text += k > 0 ? ",\n {" : "\n {";
    const std::vector<Series<double>>& thrust = law.instants[k].thrust;
    for (std::size_t m = 0; m < space.size(); ++m) {
      text += fmt::format("{}\n  {{{:.17g}, {:.17g}, {:.17g}}}", m > 0 ? "," : "", thrust[0][m],
                          thrust[1][m], thrust[2][m]);
    }
    text += "}";
  }
  return text + fmt::format(R"(}};

/* The acceleration in m/s^2 at an instant, counted from 0, for the deputy's position (m) and
   velocity (m/s) relative to its chief. Returns 0, or -1 if there is no such instant. */
int hamjet_thrust(int instant, const double position_m[3], const double velocity_m_s[3],
                  double thrust_m_s2[3]) {{
  double x[6][{0} + 1];
  int i, m;
  if (instant < 0 || instant >= HAMJET_INSTANTS) return -1;
  for (i = 0; i < 6; ++i) {{
    int e;
    x[i][0] = 1;
    for (e = 1; e <= {0}; ++e) {{
      x[i][e] = x[i][e - 1] * (i < 3 ? position_m[i] : velocity_m_s[i - 3]);
    }}
  }}
  for (i = 0; i < 3; ++i) thrust_m_s2[i] = 0;
  for (m = 0; m < HAMJET_MONOMIALS; ++m) {{
    double value = 1;
    for (i = 0; i < 6; ++i) value *= x[i][powers[m][i]];
    for (i = 0; i < 3; ++i) thrust_m_s2[i] += coefficients[instant][m][i] * value;
  }}
  return 0;
}}
)",
                            order);
}

}  // namespace hamjet::io
