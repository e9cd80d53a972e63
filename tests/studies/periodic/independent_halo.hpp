#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>


// The circular restricted three-body problem in positions and velocities, with its variational
// equations, in long double by the extrapolation of Gragg, Bulirsch and Stoer; and halo orbits by
// the differential correction of half a turn (K. C. Howell, Celestial Mechanics 32 (1984) 53). It
// shares no code with the library.

namespace hamjet::test {

/// State and state transition matrix, by rows.
using HaloState = std::array<long double, 42>;

class RestrictedProblem {
 public:
  explicit RestrictedProblem(long double mu) : mu_(mu) {}

  static HaloState start(long double x, long double z, long double vy) {
    HaloState s{};
    s[0] = x;
    s[2] = z;
    s[4] = vy;
    for (std::size_t i = 0; i < 6; ++i) s[6 + 7 * i] = 1;
    return s;
  }

  HaloState slope(const HaloState& s) const {
    const long double x = s[0], y = s[1], z = s[2];
    const long double dx = x + mu_, ex = x - 1 + mu_;
    const long double r1 = std::sqrt(dx * dx + y * y + z * z);
    const long double r2 = std::sqrt(ex * ex + y * y + z * z);
    const long double a = (1 - mu_) / (r1 * r1 * r1), b = mu_ / (r2 * r2 * r2);
    const long double a5 = 3 * a / (r1 * r1), b5 = 3 * b / (r2 * r2);
    HaloState f{};
    for (std::size_t i = 0; i < 3; ++i) f[i] = s[3 + i];
    f[3] = 2 * s[4] + x - a * dx - b * ex;
    f[4] = -2 * s[3] + y - (a + b) * y;
    f[5] = -(a + b) * z;
    const long double xx = 1 - a - b + a5 * dx * dx + b5 * ex * ex;
    const long double yy = 1 - a - b + (a5 + b5) * y * y;
    const long double zz = -a - b + (a5 + b5) * z * z;
    const long double xy = (a5 * dx + b5 * ex) * y;
    const long double xz = (a5 * dx + b5 * ex) * z;
    const long double yz = (a5 + b5) * y * z;
    for (std::size_t j = 0; j < 6; ++j) {
      const auto m = [&](std::size_t i) { return s[6 + 6 * i + j]; };
      for (std::size_t i = 0; i < 3; ++i) f[6 + 6 * i + j] = m(3 + i);
      f[24 + j] = xx * m(0) + xy * m(1) + xz * m(2) + 2 * m(4);
      f[30 + j] = xy * m(0) + yy * m(1) + yz * m(2) - 2 * m(3);
      f[36 + j] = xz * m(0) + yz * m(1) + zz * m(2);
    }
    return f;
  }

  /// The state after a time, to about 1e-17 a step.
  HaloState flown(HaloState s, long double time) const {
    long double left = time;
    long double step = std::copysign(std::min(0.05L, std::abs(time)), time);
    int halvings = 0;
    while (left != 0) {
      if (std::abs(step) > std::abs(left)) step = left;
      HaloState next;
      const long double error = extrapolated(s, step, next);
      if (error > 1e-17L) {
        if (++halvings > 200)
          throw std::runtime_error("the step of the test's integrator vanishes");
        step /= 2;
        continue;
      }
      s = next;
      left -= step;
      if (std::abs(left) < 1e-18L) left = 0;
      if (error < 1e-19L) step *= 1.5L;
    }
    return s;
  }

  long double jacobi(const HaloState& s) const {
    const long double r1 = std::hypot(s[0] + mu_, s[1], s[2]);
    const long double r2 = distance_to_second(s);
    const long double v = std::hypot(s[3], s[4], s[5]);
    return s[0] * s[0] + s[1] * s[1] + 2 * (1 - mu_) / r1 + 2 * mu_ / r2 - v * v;
  }
  long double distance_to_second(const HaloState& s) const {
    return std::hypot(s[0] - 1 + mu_, s[1], s[2]);
  }

 private:
  /// One step by extrapolation of the midpoint rule; the change by its last column.
  long double extrapolated(const HaloState& s, long double step, HaloState& result) const {
    constexpr std::size_t columns = 10;
    std::array<HaloState, columns> last{};
    long double error = 0;
    for (std::size_t k = 0; k < columns; ++k) {
      const int parts = 2 * (static_cast<int>(k) + 1);
      HaloState row = midpoint(s, step, parts);
      for (std::size_t j = 0; j < k; ++j) {
        const long double ratio = static_cast<long double>(k + 1) / static_cast<long double>(k - j);
        HaloState better = row;
        error = 0;
        for (std::size_t i = 0; i < row.size(); ++i) {
          const long double change = (row[i] - last[j][i]) / (ratio * ratio - 1);
          better[i] += change;
          const long double size = i < 6 ? 1 : matrix_size(row);
          error = std::max(error, std::abs(change) / size);
        }
        last[j] = row;
        row = better;
      }
      last[k] = row;
    }
    result = last[columns - 1];
    return error;
  }
  static long double matrix_size(const HaloState& s) {
    long double size = 1;
    for (std::size_t i = 6; i < s.size(); ++i) size = std::max(size, std::abs(s[i]));
    return size;
  }

  HaloState midpoint(const HaloState& s, long double step, int parts) const {
    const long double h = step / parts;
    HaloState before = s;
    HaloState now = s;
    const HaloState first = slope(s);
    for (std::size_t i = 0; i < s.size(); ++i) now[i] += h * first[i];
    for (int k = 1; k < parts; ++k) {
      const HaloState f = slope(now);
      for (std::size_t i = 0; i < s.size(); ++i) {
        const long double next = before[i] + 2 * h * f[i];
        before[i] = now[i];
        now[i] = next;
      }
    }
    return now;
  }

  long double mu_;
};

/// A halo orbit that crosses y = 0 at right angles at its start.
struct IndependentHalo {
  long double x = 0, z = 0, vy = 0, period = 0, jacobi = 0;
  long double least_distance = 0;        ///< from the second body, at the other crossing
  std::array<long double, 2> indices{};  ///< the larger first
};

/// The halo orbit near a start and a period with the same z.
inline IndependentHalo corrected_halo(const RestrictedProblem& problem, long double x,
                                      long double z, long double vy, long double period) {
  long double time = period / 2;
  HaloState end{};
  for (int k = 0; k < 20; ++k) {
    end = problem.flown(RestrictedProblem::start(x, z, vy), time);
    const HaloState f = problem.slope(end);
    Eigen::Matrix<long double, 3, 3> rows;
    Eigen::Matrix<long double, 3, 1> right;
    const std::array<std::size_t, 3> wanted = {1, 3, 5};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      rows(row, 0) = end[6 + 6 * wanted[i]];
      rows(row, 1) = end[6 + 6 * wanted[i] + 4];
      rows(row, 2) = f[wanted[i]];
      right(row) = -end[wanted[i]];
    }
    const Eigen::Matrix<long double, 3, 1> change = rows.fullPivLu().solve(right);
    x += change(0);
    vy += change(1);
    time += change(2);
    if (change.norm() < 1e-16L) break;
  }
  const HaloState start = RestrictedProblem::start(x, z, vy);
  const HaloState turned = problem.flown(start, 2 * time);
  Eigen::Matrix<long double, 6, 6> m;
  for (Eigen::Index i = 0; i < 6; ++i) {
    for (Eigen::Index j = 0; j < 6; ++j) m(i, j) = turned[static_cast<std::size_t>(6 + 6 * i + j)];
  }
  // tr M = 2 + 2 (n1 + n2) and tr M^2 = 2 + 4 n1^2 + 4 n2^2 - 4.
  const long double sum = (m.trace() - 2) / 2;
  const long double squares = ((m * m).trace() + 2) / 4;
  const long double root = std::sqrt(2 * squares - sum * sum);
  return {x,
          z,
          vy,
          2 * time,
          problem.jacobi(start),
          problem.distance_to_second(end),
          {(sum + root) / 2, (sum - root) / 2}};
}

}  // namespace hamjet::test
