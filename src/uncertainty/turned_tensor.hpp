#pragma once

#include <vector>

#include "hermite_coefficients.hpp"

namespace hamjet {

/// The tensor of `degree` indices, with each index transformed by the matrix.
inline std::vector<double> turned_tensor(std::vector<double> tensor, const Matrix<double>& turn,
                                         int degree) {
  for (int index = 0; index < degree; ++index) {
    // The first index is transformed and becomes the last one.
    const Eigen::Index old_size = turn.cols();
    const Eigen::Index rest =
        old_size == 0 ? 0 : static_cast<Eigen::Index>(tensor.size()) / old_size;
    const Eigen::Map<const RowMatrix> before(tensor.data(), old_size, rest);
    std::vector<double> after(static_cast<std::size_t>(rest * turn.rows()));
    Eigen::Map<RowMatrix>(after.data(), rest, turn.rows()) = (turn * before).transpose();
    tensor = std::move(after);
  }
  return tensor;
}

}  // namespace hamjet
