# Finds COIN-OR's Clp, a simplex solver, by its C interface: the target Clp::Clp. Debian's package has no
# file for CMake.
find_path(CLP_INCLUDE_DIRECTORY Clp_C_Interface.h PATH_SUFFIXES coin coin-or)
find_library(CLP_LIBRARY Clp)
mark_as_advanced(CLP_INCLUDE_DIRECTORY CLP_LIBRARY)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Clp REQUIRED_VARS CLP_LIBRARY CLP_INCLUDE_DIRECTORY)
if(Clp_FOUND AND NOT TARGET Clp::Clp)
  add_library(Clp::Clp UNKNOWN IMPORTED)
  set_target_properties(Clp::Clp PROPERTIES IMPORTED_LOCATION ${CLP_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${CLP_INCLUDE_DIRECTORY})
endif()
