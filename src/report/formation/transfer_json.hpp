#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "hamjet/studies/transfer.hpp"
#include "hamjet/studies/validity.hpp"

namespace hamjet::io {

/// Three components; null for one that is not finite.
nlohmann::ordered_json vector_json(const Eigen::Vector3d& vector);

/// What the summaries of all studies of relative motion begin with.
nlohmann::ordered_json study_head_json(const Scene& scene, const std::string& study,
                                       const std::string& integrator);

/// Why coordinates that were measured are what they are: `chosen_by_reach_m`.
void add_chosen_by(nlohmann::ordered_json& json, const ChosenCoordinates& coordinates);

/// A transfer's kind, velocity changes and misses; null where there is no answer.
nlohmann::ordered_json transfer_point_json(const TransferPoint& point, const Scene& scene);

/// `summary.json` of a transfer study, without its end.
nlohmann::ordered_json transfer_summary_json(const TransferResult& result);

}  // namespace hamjet::io
