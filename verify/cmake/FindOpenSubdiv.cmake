# SPDX-License-Identifier: MIT
# OpenSubdiv's libraries as OpenSubdiv::osdCPU and OpenSubdiv::osdGPU. Debian's own package file demands a static library that Debian does
# not ship, so this looks for headers and shared libraries itself.
find_path(OpenSubdiv_INCLUDE_DIR opensubdiv/version.h)
find_library(OpenSubdiv_LIBRARY NAMES osdCPU)
find_library(OpenSubdiv_GPU_LIBRARY NAMES osdGPU)
mark_as_advanced(OpenSubdiv_INCLUDE_DIR OpenSubdiv_LIBRARY OpenSubdiv_GPU_LIBRARY)

if(OpenSubdiv_INCLUDE_DIR)
  # 3.5.0 is written as 30500.
  file(STRINGS "${OpenSubdiv_INCLUDE_DIR}/opensubdiv/version.h" OpenSubdiv_VERSION_LINE
    REGEX "define[ \t]+OPENSUBDIV_VERSION_NUMBER[ \t]+[0-9]+")
  string(REGEX MATCH "[0-9]+$" OpenSubdiv_VERSION_NUMBER "${OpenSubdiv_VERSION_LINE}")
  if(OpenSubdiv_VERSION_NUMBER)
    math(EXPR OpenSubdiv_MAJOR "${OpenSubdiv_VERSION_NUMBER} / 10000")
    math(EXPR OpenSubdiv_MINOR "${OpenSubdiv_VERSION_NUMBER} / 100 % 100")
    math(EXPR OpenSubdiv_PATCH "${OpenSubdiv_VERSION_NUMBER} % 100")
    set(OpenSubdiv_VERSION "${OpenSubdiv_MAJOR}.${OpenSubdiv_MINOR}.${OpenSubdiv_PATCH}")
  endif()
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenSubdiv
  REQUIRED_VARS OpenSubdiv_LIBRARY OpenSubdiv_GPU_LIBRARY OpenSubdiv_INCLUDE_DIR VERSION_VAR OpenSubdiv_VERSION)

if(OpenSubdiv_FOUND AND NOT TARGET OpenSubdiv::osdCPU)
  add_library(OpenSubdiv::osdCPU UNKNOWN IMPORTED)
  set_target_properties(OpenSubdiv::osdCPU PROPERTIES
    IMPORTED_LOCATION "${OpenSubdiv_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${OpenSubdiv_INCLUDE_DIR}")
  add_library(OpenSubdiv::osdGPU UNKNOWN IMPORTED)
  set_target_properties(OpenSubdiv::osdGPU PROPERTIES
    IMPORTED_LOCATION "${OpenSubdiv_GPU_LIBRARY}"
    INTERFACE_LINK_LIBRARIES OpenSubdiv::osdCPU)
endif()
