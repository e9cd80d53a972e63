#pragma once

#include "hamjet/algebra/extended.hpp"
#include "hamjet/detail/algebra/double_double.hpp"

namespace hamjet {

/// The number type that a file of templates is compiled for. The build compiles each such file
/// twice, for double with all optimisation and for Extended with little (FOR_EACH_REAL in
/// layers.cmake), and the files that references need for DoubleDouble, too.
using InstantiatedReal = HAMJET_INSTANTIATED_REAL;

}  // namespace hamjet
