#pragma once

#include <Eigen/Core>

#include "hamjet/instruction_set.hpp"

// Eigen must be configured as it was when the library was compiled, because each side frees memory
// that the other one allocates.
static_assert(EIGEN_DEFAULT_ALIGN_BYTES == hamjet::built_for::eigen_alignment &&
                  EIGEN_MAX_STATIC_ALIGN_BYTES == hamjet::built_for::eigen_static_alignment &&
                  EIGEN_MALLOC_ALREADY_ALIGNED == hamjet::built_for::eigen_uses_malloc,
              "hamjet was built with another alignment of Eigen's matrices: compile without "
              "EIGEN_MAX_ALIGN_BYTES, EIGEN_DONT_ALIGN and the like (and with -fsanitize=address "
              "only if hamjet was), or build hamjet again with the same definitions in "
              "CMAKE_CXX_FLAGS");
