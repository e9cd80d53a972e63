#include "studies/bounded/event_study.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "algebra/state_sums.hpp"
#include "hamjet/algebra/calculus.hpp"
#include "hamjet/error.hpp"
#include "hamjet/scene/scene_reader.hpp"
#include "studies/bounded/scene_gauss.hpp"

namespace hamjet {
namespace {

constexpr double event_mu = 398600.4415;
constexpr double axis_km = 9000;
constexpr double ellipse_e = 0.2;

/// An ellipse from a true anomaly of 90 degrees, where x = r cos f vanishes; inclined by 50
/// degrees, with the node along x and the pericentre at the node.
Scene scene_with_event(const std::string& event, double revolutions = 2) {
  const std::string text =
      "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n[nominal]\na_km = 9000\ne = 0.2\n"
      "i_deg = 50\nraan_deg = 0\nargp_deg = 0\nta_deg = 90\n[jet]\norder = 3\nduration_orbits = " +
      std::to_string(revolutions) + "\n[event]\n" + event;
  return io::parse_scene(text, "kepler.toml");
}

/// Seconds from the pericentre to a true anomaly, by Kepler's equation.
double since_pericentre(double anomaly) {
  const double E =
      2 * std::atan(std::sqrt((1 - ellipse_e) / (1 + ellipse_e)) * std::tan(anomaly / 2));
  return (E - ellipse_e * std::sin(E)) * std::sqrt(axis_km * axis_km * axis_km / event_mu);
}
const double full_period = 2 * std::numbers::pi * std::sqrt(axis_km * axis_km * axis_km / event_mu);
const double passed = since_pericentre(std::numbers::pi / 2);

double time_of(const std::string& event, double revolutions = 2) {
  return study_event(scene_with_event(event, revolutions)).time_s();
}

// Times of nodes, apsides, distances and planes of a Kepler ellipse, from Kepler's equation.
TEST(EventStudy, FindsEventsOfKeplersEllipse) {
  // The apocentre is the descending node, half a period after the pericentre.
  EXPECT_NEAR(time_of("surface = \"equator\""), full_period / 2 - passed, 1e-7);
  EXPECT_NEAR(time_of("surface = \"equator\"\ndirection = \"rising\""), full_period - passed, 1e-7);
  EXPECT_NEAR(time_of("surface = \"equator\"\nnumber = 3"), 1.5 * full_period - passed, 1e-7);
  EXPECT_NEAR(time_of("surface = \"apsis\""), full_period / 2 - passed, 1e-7);
  EXPECT_NEAR(time_of("surface = \"apsis\"\ndirection = \"falling\"\nnumber = 2"),
              1.5 * full_period - passed, 1e-7);
  // r = a (1 - e^2) / (1 + e cos f): at 9000 km cos f = -e, once outwards and once inwards.
  const double f = std::acos(-ellipse_e);
  EXPECT_NEAR(time_of("surface = \"distance\"\ndistance_km = 9000"), since_pericentre(f) - passed,
              1e-7);
  EXPECT_NEAR(time_of("surface = \"distance\"\ndistance_km = 9000\ndirection = \"falling\""),
              full_period - since_pericentre(f) - passed, 1e-7);
  // x = r cos f = -7200 km: r = a (1 - e^2) - e x = 10080 km, cos f = -7200 / 10080; outwards
  // first.
  const double g = std::acos(-7200.0 / 10080);
  EXPECT_NEAR(time_of("surface = \"plane\"\nnormal = [-3, 0, 0]\noffset_km = 7200"),
              since_pericentre(g) - passed, 1e-7);
  // Backwards the last pericentre is met first, and the product of position and velocity still
  // grows with time there.
  EXPECT_NEAR(time_of("surface = \"apsis\"\ndirection = \"rising\"", -2), -passed, 1e-7);
}

// A start on the surface is no event.
TEST(EventStudy, DoesNotCountTheStart) {
  Scene scene = scene_with_event("surface = \"plane\"\nnormal = [1, 0, 0]");
  // The start, at 90 degrees from the node, has x = 0 to rounding; the plane is met again at -90.
  const double f = -std::numbers::pi / 2;
  EXPECT_NEAR(study_event(scene).time_s(), full_period + since_pericentre(f) - passed, 1e-7);
}

// The time at which a neighbour of another semi-major axis, in the same place, meets its own
// apocentre, by its own elements.
TEST(EventStudy, HasTheTimesOfNeighbours) {
  const EventStudy study = study_event(scene_with_event("surface = \"apsis\"\nnumber = 1"));
  const auto own_time = [&](double change) {
    // Faster by a part `change` at 90 degrees: r = p0, v_r = e sqrt(mu/p0), v_t = sqrt(mu/p0).
    const double p0 = axis_km * (1 - ellipse_e * ellipse_e);
    const double faster = 1 + change;
    const double radial = ellipse_e * faster;
    const double across = faster;
    const double axis = p0 / (2 - (radial * radial + across * across));
    const double parameter = p0 * across * across;
    const double eccentricity = std::sqrt(1 - parameter / axis);
    // e cos f = p/r - 1, e sin f = v_r sqrt(p/mu).
    const double anomaly = std::atan2(radial * across, across * across - 1);
    const double E =
        2 * std::atan(std::sqrt((1 - eccentricity) / (1 + eccentricity)) * std::tan(anomaly / 2));
    const double n = std::sqrt(event_mu / (axis * axis * axis));
    return (std::numbers::pi - (E - eccentricity * std::sin(E))) / n;
  };
  ASSERT_NEAR(own_time(0), study.time_s(), 1e-7);
  const auto miss = [&](double change) {
    std::vector<double> deviation(6, 0.0);
    for (std::size_t i = 3; i < 6; ++i) deviation[i] = study.scene.nominal[i] * change;
    return std::abs(evaluate<double>(study.map.time, deviation) * study.scene.units.time_s -
                    own_time(change));
  };
  // Order 3 leaves the fourth power.
  EXPECT_LT(miss(1e-4), 1e-6);
  EXPECT_NEAR(std::log2(miss(4e-3) / miss(2e-3)), 4, 0.3);
}

/// A Kepler ellipse through a state, by its own elements.
struct KeplersEllipse {
  KeplersEllipse(double mu, const std::vector<double>& state) {
    const Eigen::Vector3d x(state.data()), v(state.data() + 3);
    const Eigen::Vector3d vector = v.cross(x.cross(v)) / mu - x.normalized();
    a = 1 / (2 / x.norm() - v.squaredNorm() / mu);
    e = vector.norm();
    n = std::sqrt(mu / (a * a * a));
    along = vector / e;
    across = x.cross(v).normalized().cross(along);
    // e sin E and e cos E of the state.
    const double sine = x.dot(v) / std::sqrt(mu * a);
    mean = std::atan2(sine, 1 - x.norm() / a) - sine;
  }
  double time_of_apocentre() const { return (std::numbers::pi - mean) / n; }
  Eigen::Vector3d place(double time) const {
    const double anomaly = mean + n * time;
    double E = anomaly;
    for (int k = 0; k < 20; ++k) E = anomaly + e * std::sin(E);
    return a * (std::cos(E) - e) * along + a * std::sqrt(1 - e * e) * std::sin(E) * across;
  }

  double a, e, n, mean;
  Eigen::Vector3d along, across;
};

// Near a circle the series of an apsis are those of an angle in deviations over the eccentricity:
// misses differ by powers of ten from one direction to another. Deputies at random are within three
// times of what is told.
TEST(EventStudy, TellsTheMissesOfTheWorstDeputies) {
  for (const int order : {1, 4}) {
    const Scene scene = io::parse_scene(
        "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n[nominal]\na_km = 9000\n"
        "e = 2e-4\ni_deg = 50\nraan_deg = 0\nargp_deg = 0\nta_deg = 200\n[jet]\norder = " +
            std::to_string(order) +
            "\nduration_orbits = 1.5\n[event]\nsurface = \"apsis\"\ndirection = \"falling\"\n"
            "amplitudes_m = [1, 100]\n",
        "kepler.toml");
    const EventStudy study = study_event(scene);
    const double mu =
        398600.4415 * std::pow(scene.units.time_s, 2) / std::pow(scene.units.length_km, 3);
    const double metres = scene.units.length_km * 1000;
    ASSERT_NEAR(KeplersEllipse(mu, scene.nominal).time_of_apocentre() * scene.units.time_s,
                study.time_s(), 1e-5);
    std::mt19937_64 generator(7);
    std::normal_distribution<double> normal;
    for (const EventMisses& told : study.misses) {
      double worst = 0;
      double worst_time = 0;
      for (int k = 0; k < 500; ++k) {
        std::vector<double> deviation;
        for (const double size : {1.0, std::sqrt(mu / std::pow(9000e3 / metres, 3))}) {
          const Eigen::Vector3d direction =
              Eigen::Vector3d(normal(generator), normal(generator), normal(generator)).normalized();
          for (const double x : direction)
            deviation.push_back(x * size * told.amplitude_m / metres);
        }
        const KeplersEllipse own(mu, state_sum(scene.nominal, deviation));
        const double time = evaluate<double>(study.map.time, deviation);
        Eigen::Vector3d predicted;
        for (std::size_t i = 0; i < 3; ++i) {
          predicted[static_cast<Eigen::Index>(i)] = evaluate<double>(study.map.state[i], deviation);
        }
        worst = std::max(worst, (predicted - own.place(time)).norm() * metres);
        worst_time =
            std::max(worst_time, std::abs(own.time_of_apocentre() - time) * scene.units.time_s);
      }
      ASSERT_TRUE(told.position_m && told.time_s);
      EXPECT_LT(worst, 3 * *told.position_m + 1e-4) << order << ' ' << told.amplitude_m;
      EXPECT_LT(worst_time, 3 * *told.time_s + 1e-6) << order << ' ' << told.amplitude_m;
    }
  }
}

// A pericentre at the start is none after it, wherever the duration ends.
TEST(EventStudy, DoesNotCountAnApsisAtTheStart) {
  const std::string at_pericentre =
      "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n"
      "[nominal]\na_km = 9000\ne = 0.2\ni_deg = 50\nta_deg = 0\n";
  const std::string event = "[jet]\norder = 1\nduration_orbits = 1\n[event]\nsurface = \"apsis\"\n";
  for (int k = 0; k < 20; ++k) {
    const std::string angles = "raan_deg = " + std::to_string(17 * k % 360) +
                               "\nargp_deg = " + std::to_string(29 * k % 360) + "\n";
    const Scene scene = io::parse_scene(at_pericentre + angles + event, "kepler.toml");
    EXPECT_NEAR(study_event(scene).time_s(), full_period / 2, 1e-7) << k;
  }
}

// Just below the apocentre, 10800 km, the distance is met twice within a minute and less, between
// two places of the search.
TEST(EventStudy, FindsEventsThatAreCloseToEachOther) {
  for (const double below_km : {100.0, 3.0, 0.1, 1e-3}) {
    const double distance = axis_km * (1 + ellipse_e) - below_km;
    // 1 + cos f, of r (1 + e cos f) = a (1 - e^2).
    const double rest =
        (axis_km * (1 - ellipse_e * ellipse_e) / distance - (1 - ellipse_e)) / ellipse_e;
    const double from_apocentre = 2 * std::asin(std::sqrt(rest / 2));
    const double time = since_pericentre(std::numbers::pi - from_apocentre);
    const auto of_number = [&](int number) {
      return time_of("surface = \"distance\"\ndistance_km = " + std::to_string(distance) +
                         "\nnumber = " + std::to_string(number),
                     2);
    };
    // The text has a thousandth of a metre, which is a time of that over the small radial speed.
    const double allowed = 1e-5 + 1e-3 / std::sqrt(below_km);
    EXPECT_NEAR(of_number(1), time - passed, allowed) << below_km;
    EXPECT_NEAR(of_number(2), full_period - time - passed, allowed) << below_km;
    EXPECT_NEAR(of_number(3), full_period + time - passed, allowed) << below_km;
  }
}

// The flights are those of the scene's own Gauss method, and other methods are refused.
TEST(EventStudy, FliesByTheScenesIntegrator) {
  Scene scene = scene_with_event("surface = \"equator\"");
  EXPECT_EQ(scene_gauss_label(scene), "gauss8");
  IntegratorSettings& integrator = scene.integrators.at(0);
  integrator.label = "coarse";
  integrator.stages = 3;
  integrator.tolerance = 1e-3;
  EXPECT_EQ(scene_gauss_label(scene), "coarse");
  EXPECT_EQ(scene_gauss(scene, 1e-14).stages, 3);
  EXPECT_EQ(scene_gauss(scene, 1e-14).tolerance, 1e-14);
  integrator.tolerance = 1e-16;
  EXPECT_EQ(scene_gauss(scene, 1e-14).tolerance, 1e-16);
  integrator.method = IntegrationMethod::velocity_verlet;
  try {
    study_event(scene);
    FAIL() << "the scene has no Gauss method";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::scene);
    EXPECT_EQ(std::string(error.what()).rfind("integrator: returns and events", 0), 0U)
        << error.what();
  }
}

TEST(EventStudy, RefusesWhatIsNotMet) {
  const auto refused = [&](const std::string& event, ErrorKind kind, const std::string& words) {
    try {
      study_event(scene_with_event(event));
      FAIL() << event << " was not refused";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), kind) << error.what();
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  refused("surface = \"distance\"\ndistance_km = 20000", ErrorKind::scene, "has none");
  refused("surface = \"apsis\"\nnumber = 5", ErrorKind::scene, "has 4; must be at most 4");
}

}  // namespace
}  // namespace hamjet
