# The layers from the bottom, a folder each in include/hamjet and src: none includes from one above
# its own.
set(HAMJET_LAYERS text algebra dynamics astronomy integrators maps charts poincare relative_motion uncertainty
  optimal_control studies store formats scene report sweep app cli python)

# Files that a unity build compiles together, of one folder: fewer compile longer from nothing and sooner
# after a change.
set(HAMJET_UNITY_FILES 24 CACHE STRING "Files of a folder that a unity build compiles together")

# Adds the library, of three targets: each compiles the templates over the number type for one of them (see
# below), and the shell also the layers whose speed does not matter. src/CMakeLists.txt says with which
# options, and tests/fuzz/CMakeLists.txt with which others.
macro(hamjet_add_library)
  add_library(hamjet STATIC $<TARGET_OBJECTS:hamjet_shell> $<TARGET_OBJECTS:hamjet_double_double>)
  add_library(hamjet_shell OBJECT)
  add_library(hamjet_double_double OBJECT)
  target_compile_definitions(hamjet PRIVATE HAMJET_INSTANTIATED_REAL=double)
  target_compile_definitions(hamjet_shell PRIVATE HAMJET_INSTANTIATED_REAL=Extended)
  target_compile_definitions(hamjet_double_double PRIVATE HAMJET_INSTANTIATED_REAL=DoubleDouble)
  set(HAMJET_SHELL hamjet_shell)
  set(HAMJET_LIBRARY_TARGETS hamjet hamjet_shell hamjet_double_double)
endmacro()

# Adds to the target all sources of the layer whose CMakeLists.txt calls it, but those behind EXCEPT, which
# it adds itself. With CMAKE_UNITY_BUILD those of a folder are compiled together, so many at a time.
# Those behind FOR_EACH_REAL are templates over the number type and are compiled twice, each time for one
# HAMJET_INSTANTIATED_REAL: for double with the target, and for Extended with the shell. In extended precision
# the time goes into software arithmetic, for which all optimisation takes long to compile and gains nothing.
function(hamjet_layer_sources target)
  cmake_parse_arguments(PARSE_ARGV 1 layer "" "" "EXCEPT;FOR_EACH_REAL")
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}
    ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  if(layer_EXCEPT)
    list(REMOVE_ITEM sources ${layer_EXCEPT})
  endif()
  target_sources(${target} PRIVATE ${sources})
  target_sources(${HAMJET_SHELL} PRIVATE ${layer_FOR_EACH_REAL})
  get_filename_component(name ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  set(together ${HAMJET_UNITY_FILES})
  foreach(source ${sources})
    get_filename_component(folder ${name}/${source} DIRECTORY)
    string(MAKE_C_IDENTIFIER ${folder} group)
    if(NOT DEFINED count_${group})
      set(count_${group} 0)
    endif()
    math(EXPR part "${count_${group}} / ${together}")
    math(EXPR count_${group} "${count_${group}} + 1")
    set_property(SOURCE ${source} TARGET_DIRECTORY ${target} PROPERTY UNITY_GROUP ${group}_${part})
  endforeach()
endfunction()
