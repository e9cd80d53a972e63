#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/integrators/flow_problem.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet::io {

/// The text of a `jet.csv`; components and variables are indices of the names of the model's state.
std::string coefficients_csv(const std::vector<std::string_view>& names,
                             const std::vector<std::size_t>& components,
                             const std::vector<std::size_t>& variables, Precision precision,
                             const FlowJet<Extended>& jet);

}  // namespace hamjet::io
