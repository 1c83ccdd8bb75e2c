# Installation in two parts, so that a user of the core needs nothing but Eigen and tl::expected:
#   adit::adit  the core: every module that the localizer is made of
#   adit::io    files and configuration on top of it (links fmt and toml++); component `io` of the package
# Pictures, simulation and evaluation serve the command and are not installed.
include(CMakePackageConfigHelpers)

set(adit_core_modules geometry threads motion scan deskew map visibility features prediction
  extraction scan_motion matching estimation information refinement tracking places relocation
  recovery localizer)
set(adit_io_modules)
if(ADIT_BUILD_APPS)
  set(adit_io_modules io config)
endif()
set(adit_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/adit)

add_library(adit_core INTERFACE)
set_target_properties(adit_core PROPERTIES EXPORT_NAME adit)
add_library(adit::adit ALIAS adit_core)

# adit_install(export_set target...): libraries of one part, and the headers of those that are modules.
function(adit_install export_set)
  foreach(target IN LISTS ARGN)
    install(TARGETS ${target} EXPORT ${export_set}
      ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
    string(REGEX REPLACE "^adit_" "" module ${target})
    set(headers ${PROJECT_SOURCE_DIR}/src/adit/${module})
    if(IS_DIRECTORY ${headers})
      install(DIRECTORY ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/adit
        FILES_MATCHING PATTERN "*.hpp")
    endif()
  endforeach()
  install(EXPORT ${export_set} NAMESPACE adit:: DESTINATION ${adit_package_dir})
endfunction()

list(TRANSFORM adit_core_modules PREPEND adit_ OUTPUT_VARIABLE core_targets)
target_link_libraries(adit_core INTERFACE ${core_targets})
adit_install(adit-core-targets ${core_targets} adit_core)
if(adit_io_modules)
  list(TRANSFORM adit_io_modules PREPEND adit_ OUTPUT_VARIABLE io_targets)
  adit_install(adit-io-targets ${io_targets})
  # A configuration holds the options of the survey, whether or not it is built.
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/adit/survey
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/adit FILES_MATCHING PATTERN "*.hpp")
endif()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/adit-config.cmake.in
  ${CMAKE_BINARY_DIR}/adit-config.cmake INSTALL_DESTINATION ${adit_package_dir})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/adit-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/adit-config.cmake ${CMAKE_BINARY_DIR}/adit-config-version.cmake
  DESTINATION ${adit_package_dir})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/adit)
