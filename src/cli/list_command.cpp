#include "list_command.hpp"

#include <fmt/format.h>

#include "hamjet/integrators/cvode.hpp"
#include "hamjet/maps/generating_function_kind.hpp"
#include "standard_streams.hpp"

namespace hamjet::cli {
namespace {

std::string systems() {
  return "zonal-gravity        Earth orbit with J2 to J20, each optional: mu_km3_s2, radius_km, "
         "J2, "
         "..., J20; or gravity_file (ICGEM .gfc) with highest_zonal or zonals\n"
         "kepler               Kepler's problem: mu_km3_s2\n"
         "harmonic-oscillator  one degree of freedom: mass_kg, stiffness_N_per_m\n"
         "double-well          one degree of freedom, H = p^2/2 + (q^4 - q^2)/2\n"
         "oscillator-pair      two oscillators without coupling: mass_kg, stiffness_N_per_m = [k1, "
         "k2]\n"
         "spring-pendulum      mass on a spring in a plane, q2 upwards: mass_kg, "
         "stiffness_N_per_m, "
         "length_m, gravity_m_s2\n"
         "fermi-pasta-ulam     chain of stiff linear and soft quartic springs: omega_rad_per_s, "
         "pairs (1 to 4)\n";
}

std::string integrators() {
  const char* cvode = cvode_available() ? "" : "  NOT BUILT: configure with -DHAMJET_CVODE=ON";
  return fmt::format(
      "gauss        Gauss collocation, 1 (implicit midpoint) to 12 stages, order 2 stages; "
      "symplectic; "
      "step_canonical, step_s or tolerance; compensated_summation\n"
      "stormer      Störmer's rule of the paper (symplectic Euler), order 1; symplectic; "
      "step_canonical or step_s\n"
      "velocity-verlet  order 2, and symmetric compositions of it of order 4, 6, 8; symplectic; "
      "step_canonical or step_s\n"
      "newmark      gamma = 1/2, beta from 0 to 1/2, implicit for beta > 0, order 2; not "
      "symplectic "
      "in (q, p) for beta > 0; step_canonical or step_s\n"
      "fehlberg78   explicit Runge-Kutta-Fehlberg 7(8) of Boost.odeint; not symplectic; "
      "step_canonical, step_s or tolerance\n"
      "cvode-adams  Adams method of SUNDIALS CVODE; not symplectic; tolerance{}\n"
      "cvode-bdf    backward differentiation of SUNDIALS CVODE, for stiff systems; not symplectic; "
      "tolerance{}\n",
      cvode, cvode);
}

std::string kinds() {
  std::string text =
      "A generating function takes one final and one initial variable of each pair (q, p):\n"
      "F1 (q, q0)   F2 (q, p0)   F3 (p, q0)   F4 (p, p0)   auto (the best conditioned of all)\n"
      "For an orbit, final choice, hyphen, initial choice for x, y, z (for another model as many "
      "letters as\ndegrees of freedom):\n";
  const auto all = all_kinds(3);
  for (std::size_t i = 0; i < all.size(); ++i) {
    text += all[i].name() + (i % 8 == 7 ? "\n" : "  ");
  }
  return text;
}

}  // namespace

int list(const std::string& what) {
  if (what == "systems") print(systems());
  if (what == "integrators") print(integrators());
  if (what == "kinds") print(kinds());
  return 0;
}

}  // namespace hamjet::cli
