#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../maps/affine_symplectic_map.hpp"
#include "../text/scene_message.hpp"
#include "hamjet/error.hpp"
#include "scene_sections.hpp"

namespace hamjet::io {
namespace {

/// A figure could not distinguish more step sizes.
constexpr std::size_t most_step_sizes = 8;

const std::vector<std::string_view> forms = {"rotation_cosine", "rotation_angle_rad", "matrix"};

AffineSymplecticMap<Extended> read_rotation(const TableReader& table, std::string_view key,
                                            std::size_t degrees_of_freedom) {
  if (degrees_of_freedom != 1) {
    table.fail(key, fmt::format("a rotation of the plane (q, p), got a model with {} degrees of "
                                "freedom, must be matrix instead",
                                degrees_of_freedom));
  }
  if (key == "rotation_angle_rad") {
    return phase_plane_rotation<Extended>(Extended(table.number(key)));
  }
  const Extended cosine = table.number(key);
  return phase_plane_rotation<Extended>(Extended(acos(cosine)));
}

/// Refuses a matrix that is not symplectic to the rounding of its decimals. The nearest symplectic
/// matrix in extended precision replaces it, because its powers are formed in that precision.
AffineSymplecticMap<Extended> read_matrix(const TableReader& table, std::size_t size) {
  const std::vector<double> entries = table.square_matrix("matrix", size);
  const auto rows = static_cast<Eigen::Index>(size);
  Matrix<double> matrix(rows, rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index j = 0; j < rows; ++j) {
      matrix(i, j) = entries[static_cast<std::size_t>(i * rows + j)];
    }
  }
  const MatrixSymplecticityDefect defect = symplecticity_defect(matrix);
  if (!(defect.relative <= largest_symplecticity_defect<double>())) {
    table.fail(
        "matrix",
        fmt::format("not symplectic, got a matrix A with {:.3g} as the largest entry of "
                    "A J A^T - J ({:.3g} relative), must be at most {:.2g} relative, with "
                    "J = [[0, 1], [-1, 0]] in blocks and the variables (q, p)",
                    defect.absolute, defect.relative, largest_symplecticity_defect<double>()));
  }
  Vector<double> shift = Vector<double>::Zero(rows);
  if (table.has("shift")) {
    const std::vector<double> given = table.numbers("shift", size);
    shift = Eigen::Map<const Vector<double>>(given.data(), rows);
  }
  return {nearest_symplectic<Extended>(matrix.cast<Extended>()), shift.cast<Extended>()};
}

AffineSymplecticMap<Extended> read_transformation(const TableReader& table, std::size_t size) {
  const std::string_view form = table.exactly_one_of(forms);
  if (form == "matrix") return read_matrix(table, size);
  if (table.has("shift")) {
    table.fail("shift",
               fmt::format("without a matrix, got shift and {}, must be left out: a rotation "
                           "is about the origin",
                           form));
  }
  return read_rotation(table, form, size / 2);
}

std::vector<double> read_steps(const TableReader& table, double duration) {
  constexpr std::string_view key = "steps_canonical";
  const std::vector<double> steps = table.numbers(key);
  if (steps.size() > most_step_sizes) {
    table.fail(key, fmt::format("too many step sizes, got {}, must be at most {}", steps.size(),
                                most_step_sizes));
  }
  double total = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (!(steps[i] > 0)) {
      table.fail_element(key, i,
                         fmt::format("not positive, got {}, must be a number above 0", steps[i]));
    }
    if (std::find(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(i), steps[i]) !=
        steps.begin() + static_cast<std::ptrdiff_t>(i)) {
      table.fail_element(
          key, i, fmt::format("duplicate step size, got {} again, must be there once", steps[i]));
    }
    total += std::ceil(duration / steps[i]);
  }
  if (total > largest_transformed_step_count) {
    throw Error(ErrorKind::too_large,
                fmt::format("{}: too many steps, got {:.3g} in all over a duration of {}, must be "
                            "at most {:.0e}",
                            table.head(key), total, duration, largest_transformed_step_count));
  }
  return steps;
}

}  // namespace

const TableDescription& canonical_transformation_table() {
  static const TableDescription table = {
      {{"steps_canonical",
        form::words(fmt::format("array of 1 to {} different numbers above 0", most_step_sizes),
                    form::array(form::positive())),
        absent::refused(), "step sizes of the midpoint rule, each a run of its own"},
       {"duration_canonical", form::positive(), absent::refused(),
        "the duration, at most 1e7 steps in all"},
       {"rotation_cosine", form::between(-1, 1), absent::other("another form"),
        "cosine of a rotation of the plane (q, p), for one degree of freedom"},
       {"rotation_angle_rad", form::number(), absent::other("another form"),
        "angle of the rotation, for one degree of freedom"},
       {"matrix", form::words("array of 2n arrays of 2n numbers", form::array(form::number())),
        absent::other("another form"), "a symplectic matrix in the variables (q, p)"},
       {"shift", form::words("array of 2n numbers", form::array(form::number())),
        absent::other("0"), "added to `matrix` times (q, p)"},
       {"require_invariance", form::positive(), absent::other("no check"),
        "largest difference of the energy errors"}},
      "One of `rotation_cosine`, `rotation_angle_rad` and `matrix` must be there."};
  return table;
}

CanonicalTransformationStudy read_canonical_transformation(const TableReader& root) {
  CanonicalTransformationStudy study;
  read_start(root, study);
  const TableReader table = root.table("canonical_transformation");
  table.check_keys();
  study.duration = table.number("duration_canonical");
  study.steps = read_steps(table, study.duration);
  study.transformation = read_transformation(table, study.nominal.size());
  table.read_if_any("require_invariance", study.require_invariance);
  return study;
}

}  // namespace hamjet::io
