#include <algorithm>
#include <cmath>
#include <limits>

#include "../integrators/concurrent_tasks.hpp"
#include "entry_sampler.hpp"
#include "hamjet/error.hpp"
#include "hamjet/uncertainty/collision_probability.hpp"
#include "relative_paths.hpp"
#include "sampled_paths.hpp"

namespace hamjet {

LeastSeparations least_separations(const EncounterProblem& problem,
                                   const CollisionSettings& settings,
                                   const std::vector<double>& shares) {
  validate(problem);
  for (const double share : shares) {
    if (!(share > 0 && share < 1)) {
      throw Error(ErrorKind::usage, "least separations: a share must be between 0 and 1");
    }
  }
  // Separations are told to a part of the radius, and no path is left out.
  constexpr double accuracy = 0.01;
  const RelativePaths paths(problem, accuracy * problem.radius,
                            std::numeric_limits<double>::infinity());
  const auto count = static_cast<std::size_t>(std::max(1L, settings.samples));
  const std::size_t tasks = (count + samples_in_block - 1) / samples_in_block;
  std::vector<double> least(count);
  run_concurrently(
      tasks, settings.threads,
      [&](std::size_t task, TaskControl& control) {
        RandomStream random(settings.seed, task);
        std::vector<double> points(encounter_variables * samples_in_block);
        for (std::size_t j = 0; j < samples_in_block; ++j) {
          for (std::size_t i = 0; i < encounter_variables; ++i) {
            points[i * samples_in_block + j] = random.normal();
          }
        }
        std::vector<double> states(6 * paths.times().size() * samples_in_block);
        paths.evaluate(points, problem.order, states);
        std::vector<std::array<double, 6>> path(paths.times().size());
        for (std::size_t j = 0; j < in_block(count, task * samples_in_block); ++j) {
          take_path(states, samples_in_block, j, path);
          least[task * samples_in_block + j] = least_distance(paths, path);
        }
        control.advance();
      },
      [&](long done) {
        if (settings.progress) {
          settings.progress(static_cast<double>(done) / static_cast<double>(tasks));
        }
      });
  std::sort(least.begin(), least.end());
  LeastSeparations result{shares, {}, static_cast<long>(least.size())};
  for (const double share : shares) {
    const auto place = static_cast<std::size_t>(share * static_cast<double>(least.size()));
    result.separations.push_back(least[std::min(place, least.size() - 1)]);
  }
  return result;
}

}  // namespace hamjet
