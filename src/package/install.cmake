# What cmake --install puts where: the library with its headers and the package that find_package
# finds, the command with its data, completion and manual.
include(CMakePackageConfigHelpers)

install(TARGETS hamjet EXPORT hamjetTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/hamjet ${PROJECT_BINARY_DIR}/generated/hamjet
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN *.hpp)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/hamjet)
install(EXPORT hamjetTargets NAMESPACE hamjet:: DESTINATION ${package})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/hamjetConfig.cmake.in
  ${PROJECT_BINARY_DIR}/hamjetConfig.cmake INSTALL_DESTINATION ${package})
# Before version 1 any minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/hamjetConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/hamjetConfig.cmake
  ${PROJECT_BINARY_DIR}/hamjetConfigVersion.cmake ${CMAKE_CURRENT_LIST_DIR}/FindClp.cmake
  ${CMAKE_CURRENT_LIST_DIR}/FindErfa.cmake DESTINATION ${package})

if(HAMJET_COMMAND)
  install(TARGETS hamjet_command RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  # With the files that scenes name, which lie in the same places relative to them.
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/data/scenes ${PROJECT_SOURCE_DIR}/data/gravity
    DESTINATION ${CMAKE_INSTALL_DATADIR}/hamjet
    FILES_MATCHING PATTERN *.toml PATTERN *.opm PATTERN *.oem PATTERN *.gfc PATTERN *.txt)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/data/examples/two-satellites
    DESTINATION ${CMAKE_INSTALL_DATADIR}/hamjet/examples FILES_MATCHING PATTERN *.toml)
endif()
