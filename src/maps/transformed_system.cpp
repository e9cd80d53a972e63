#include "hamjet/algebra/extended.hpp"
#include "hamjet/error.hpp"
#include "transformed_hamiltonian.hpp"

namespace hamjet {

void detail::require_same_dimension(Eigen::Index hamiltonian, Eigen::Index map) {
  if (hamiltonian != map) {
    throw Error(ErrorKind::usage,
                "transformed Hamiltonian: the map has another number of variables");
  }
}

DynamicalSystem transformed_system(const DynamicalSystem& system,
                                   const AffineSymplecticMap<Extended>& map) {
  detail::require_same_dimension(static_cast<Eigen::Index>(system.dimension()), map.dimension());
  const AffineSymplecticMap<Extended> inverse = map.inverse();
  const auto hamiltonian = record(system.dimension(), [&](std::span<const Expression> Z) {
    std::vector<Expression> z;
    for (Eigen::Index i = 0; i < inverse.dimension(); ++i) {
      Expression sum(inverse.shift()(i));
      for (Eigen::Index j = 0; j < inverse.dimension(); ++j) {
        sum += Expression(inverse.matrix()(i, j)) * Z[static_cast<std::size_t>(j)];
      }
      z.push_back(sum);
    }
    return recorded_outputs(system.hamiltonian, z);
  });
  return make_system(system.name + ", transformed", hamiltonian);
}

}  // namespace hamjet
