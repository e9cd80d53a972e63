# Finds ERFA, the essential routines for fundamental astronomy: the target Erfa::Erfa. Debian's package has
# no file for CMake.
find_path(ERFA_INCLUDE_DIRECTORY erfa.h)
find_library(ERFA_LIBRARY erfa)
mark_as_advanced(ERFA_INCLUDE_DIRECTORY ERFA_LIBRARY)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Erfa REQUIRED_VARS ERFA_LIBRARY ERFA_INCLUDE_DIRECTORY)
if(Erfa_FOUND AND NOT TARGET Erfa::Erfa)
  add_library(Erfa::Erfa UNKNOWN IMPORTED)
  set_target_properties(Erfa::Erfa PROPERTIES IMPORTED_LOCATION ${ERFA_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${ERFA_INCLUDE_DIRECTORY})
endif()
