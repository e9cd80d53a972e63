# The layers from the bottom, a folder each in include/hamjet and src: none includes from one above
# its own.
set(HAMJET_LAYERS text algebra dynamics integrators maps relative_motion optimal_control studies store
  formats scene report sweep app cli python)
