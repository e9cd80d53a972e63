# The instruction set that the library is compiled for, as the compiler's flags have it, the
# layout of vectors and matrices that follows from it, and the kind of extended precision.
include(CheckCXXSourceCompiles)
include(CheckTypeSize)

# Flag and macro of each instruction set by which the vectors of <experimental/simd> and of Eigen
# differ, or the arithmetic of an inline function that both sides compile.
set(HAMJET_INSTRUCTION_SETS
  avx=__AVX__ avx2=__AVX2__ fma=__FMA__ avx512f=__AVX512F__ avx512dq=__AVX512DQ__
  avx512bw=__AVX512BW__ avx512vl=__AVX512VL__)

# Sets HAMJET_BINARY128 to whether the compiler has numbers of 128 bits, with their library and its
# header. clang++ looks for the header where it is told, at HAMJET_QUADMATH: it belongs to g++.
function(hamjet_find_binary128)
  file(GLOB folders /usr/lib/gcc/*/*/include)
  find_path(HAMJET_QUADMATH quadmath.h HINTS ${CMAKE_CXX_IMPLICIT_INCLUDE_DIRECTORIES} PATHS ${folders})
  set(CMAKE_REQUIRED_FLAGS "-std=c++20")
  if(CMAKE_CXX_COMPILER_ID MATCHES Clang AND HAMJET_QUADMATH)
    string(APPEND CMAKE_REQUIRED_FLAGS " -idirafter ${HAMJET_QUADMATH}")
  endif()
  set(CMAKE_REQUIRED_LIBRARIES quadmath)
  set(CMAKE_REQUIRED_QUIET ON)
  check_cxx_source_compiles("extern \"C\" {
#include <quadmath.h>
}
int main(int n, char**) { return static_cast<int>(sinq(static_cast<__float128>(n))); }"
    HAMJET_BINARY128)
endfunction()

# Gives a target, and whoever links with it, what extended precision needs.
function(hamjet_use_binary128 target)
  if(HAMJET_BINARY128)
    target_compile_options(${target} PUBLIC
      $<$<COMPILE_LANG_AND_ID:CXX,Clang>:SHELL:-idirafter ${HAMJET_QUADMATH}>)
    target_link_libraries(${target} PUBLIC quadmath)
  endif()
endfunction()

# Writes the header instruction_set.hpp into `directory` for code that is compiled with `flags`
# (a list) besides those of the configuration. Sets HAMJET_INSTRUCTION_SET_FLAGS, the explicit flags
# that a user's code needs to agree.
function(hamjet_record_instruction_set directory flags)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" configuration)
  string(JOIN " " all_flags ${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${configuration}} ${flags})

  separate_arguments(arguments UNIX_COMMAND "${all_flags}")
  execute_process(
    COMMAND ${CMAKE_CXX_COMPILER} ${arguments} -E -dM -x c++ /dev/null
    OUTPUT_VARIABLE macros COMMAND_ERROR_IS_FATAL ANY)
  set(present)
  set(present_flags)
  set(absent)
  foreach(instruction_set ${HAMJET_INSTRUCTION_SETS})
    string(REPLACE "=" ";" pair ${instruction_set})
    list(GET pair 0 name)
    list(GET pair 1 macro)
    if(macros MATCHES "#define ${macro} ")
      list(APPEND present "defined(${macro})")
      list(APPEND present_flags -m${name})
    else()
      list(APPEND absent "!defined(${macro})")
    endif()
  endforeach()
  string(JOIN " && " HAMJET_SAME_INSTRUCTION_SET ${present} ${absent})
  string(JOIN " " HAMJET_FLAGS_NEEDED ${present_flags})
  if(HAMJET_FLAGS_NEEDED STREQUAL "")
    set(HAMJET_FLAGS_NEEDED "no -march and no -mavx")
  endif()

  get_target_property(eigen Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
  list(TRANSFORM eigen PREPEND -I)
  set(probe ${directory}/eigen_probe.cpp)
  file(CONFIGURE OUTPUT ${probe} CONTENT "#include <Eigen/Core>
HAMJET EIGEN_DEFAULT_ALIGN_BYTES EIGEN_MAX_STATIC_ALIGN_BYTES EIGEN_MALLOC_ALREADY_ALIGNED
")
  execute_process(COMMAND ${CMAKE_CXX_COMPILER} ${arguments} ${eigen} -std=c++20 -E -P ${probe}
    OUTPUT_VARIABLE expanded COMMAND_ERROR_IS_FATAL ANY)
  if(NOT expanded MATCHES "HAMJET ([0-9]+) ([0-9]+) ([01])")
    message(FATAL_ERROR "Eigen does not say how it aligns with: ${all_flags}")
  endif()
  set(HAMJET_EIGEN_ALIGNMENT ${CMAKE_MATCH_1})
  set(HAMJET_EIGEN_STATIC_ALIGNMENT ${CMAKE_MATCH_2})
  set(HAMJET_EIGEN_USES_MALLOC ${CMAKE_MATCH_3})
  hamjet_find_binary128()

  # Kept by flags, for a build directory may be configured again with others.
  string(MD5 key "${all_flags}")
  set(CMAKE_REQUIRED_FLAGS "${all_flags}")
  set(CMAKE_REQUIRED_QUIET ON)
  set(CMAKE_EXTRA_INCLUDE_FILES experimental/simd)
  check_type_size("std::experimental::native_simd<double>" HAMJET_VECTOR_${key} LANGUAGE CXX)
  if(NOT HAMJET_VECTOR_${key})
    message(FATAL_ERROR "the compiler has no <experimental/simd>, or not with: ${all_flags}")
  endif()
  math(EXPR HAMJET_NATIVE_LANES "${HAMJET_VECTOR_${key}} / 8")
  configure_file(${CMAKE_CURRENT_FUNCTION_LIST_DIR}/instruction_set.hpp.in
    ${directory}/instruction_set.hpp @ONLY)
  set(HAMJET_INSTRUCTION_SET_FLAGS ${present_flags} PARENT_SCOPE)
endfunction()
