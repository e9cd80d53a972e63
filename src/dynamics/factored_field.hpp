#pragma once

#include <optional>

#include "hamjet/detail/dynamics/operation_list.hpp"

namespace hamjet {

/// The vector field of a Hamiltonian that consists of sums, products and powers, with few products
/// however the Hamiltonian was written: it is multiplied out to monomials of the variables and of
/// powers of sums, such as those of a distance, and what is differentiated is put together by
/// Horner's scheme. `parameters` inputs before the time stay as they are. No value for a
/// Hamiltonian with other functions, or of very many monomials.
std::optional<OperationList> factored_field(const OperationList& hamiltonian,
                                            std::size_t parameters);

}  // namespace hamjet
