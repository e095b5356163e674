# SPDX-License-Identifier: MIT
# limitcheck_package(COMPONENT TARGETS target ... HEADERS path ...): what `cmake --install` gives to other projects as
# find_package(limitcheck COMPONENTS COMPONENT). The headers, named from the folder of the call, are those that users
# include and what these include; verify/package installs them.
include_guard(GLOBAL)
include(GNUInstallDirs)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)  # but for the program and what belongs to it
set(LIMITCHECK_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/limitcheck)

function(limitcheck_package component)
  cmake_parse_arguments(arg "" "" "TARGETS;HEADERS" ${ARGN})
  foreach(target IN LISTS arg_TARGETS)
    string(REGEX REPLACE "^limitcheck_" "" name ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  endforeach()
  install(TARGETS ${arg_TARGETS} EXPORT limitcheck_${component} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT limitcheck_${component} NAMESPACE limitcheck:: DESTINATION ${LIMITCHECK_PACKAGE_DIR}
    FILE limitcheck-${component}.cmake)
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE folder)
  list(TRANSFORM arg_HEADERS PREPEND ${folder}/)
  set_property(GLOBAL APPEND PROPERTY LIMITCHECK_INSTALLED_HEADERS ${arg_HEADERS})
endfunction()

# Definitions for tests that use installed_test.h.
set(LIMITCHECK_INSTALLED_TEST
  LIMITCHECK_PROGRAM="$<TARGET_FILE:limitcheck>"
  LIMITCHECK_VERSION="${PROJECT_VERSION}"
  LIMITCHECK_BINARY_DIR="${PROJECT_BINARY_DIR}"
  LIMITCHECK_CMAKE="${CMAKE_COMMAND}"
  LIMITCHECK_CXX="${CMAKE_CXX_COMPILER}"
  LIMITCHECK_COMPILERS="-DCMAKE_C_COMPILER=${CMAKE_C_COMPILER} -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}")
