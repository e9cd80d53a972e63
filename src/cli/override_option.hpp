#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace hamjet::cli {

/// The option --set of commands that take a scene.
inline void add_override_option(CLI::App& command, std::vector<std::string>& overrides) {
  command
      .add_option("--set", overrides,
                  "key=value: change a key of the scene, for example jet.order=3 or "
                  "integrator.gauss8.tolerance=1e-12; key=null removes it; may be repeated")
      ->type_size(1)
      ->allow_extra_args(false);
}

}  // namespace hamjet::cli
