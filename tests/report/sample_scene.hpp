#pragma once

#include "hamjet/studies/scene.hpp"

namespace hamjet::io {

/// The scene of made-up results, with markup in its title.
inline Scene sample_scene(double duration) {
  Scene scene;
  scene.name = "sample";
  scene.title = "A sample & its <title>";
  scene.units = {7000, 927.6};
  scene.nominal = {1, 0, 0, 0, 0.5, 1};
  scene.duration = duration;
  scene.order = 2;
  scene.variables = {0, 1, 2, 3, 4, 5};
  return scene;
}

}  // namespace hamjet::io
