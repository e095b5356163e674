# SPDX-License-Identifier: MIT
# `cpack` in the build folder makes three packages: limitcheck, the program, python3-limitcheck, and liblimitcheck-dev, the MIT
# libraries for others' projects. Needs dpkg-dev and file.
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL development)
if(LIMITCHECK_VERIFY)
  list(PREPEND CPACK_COMPONENTS_ALL program)
endif()
get_property(python GLOBAL PROPERTY LIMITCHECK_PYTHON)
if(python)
  list(APPEND CPACK_COMPONENTS_ALL python_package)
endif()
# The maintainer is whoever builds the packages and answers for them: as Debian's tools have it, or as git does.
set(contact "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
if(contact STREQUAL " <>")
  execute_process(COMMAND git -C ${PROJECT_SOURCE_DIR} log -1 "--format=%an <%ae>" OUTPUT_VARIABLE contact
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(NOT contact)
  cmake_host_system_information(RESULT host QUERY FQDN)
  set(contact "The limitcheck authors <root@${host}>")
endif()
set(LIMITCHECK_MAINTAINER "${contact}" CACHE STRING "Maintainer of the Debian packages: NAME <ADDRESS>")
set(CPACK_PACKAGE_CONTACT "${LIMITCHECK_MAINTAINER}")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME limitcheck)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "judges tessellators of Loop and Catmull-Clark subdivision surfaces
It judges every point that a tessellator delivers against an exact
reference, looks for cracks bit by bit, and hands back each fault with a
witness. Tessellators are built in, or shared libraries and programs of the
user's own, or finished files.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_PACKAGE_NAME python3-limitcheck)
set(CPACK_DEBIAN_PYTHON_PACKAGE_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_PACKAGE_DEPENDS "limitcheck, python3, python3-numpy")
set(CPACK_COMPONENT_PYTHON_PACKAGE_DESCRIPTION "judges tessellators of subdivision surfaces, from Python
Exact points and derivatives of the limit surface as numpy arrays, and
audits of a Python function that subdivides a mesh.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME liblimitcheck-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# What its static libraries and headers stand on.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libfmt-dev, libtbb-dev, libhwy-dev, libflint-arb-dev, libflint-dev, libmpfr-dev, libgmp-dev, libboost-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "limitcheck, cmake, pkgconf")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "exact and fast subdivision surfaces, Loop and Catmull-Clark: headers, libraries
The exact evaluator that limitcheck judges by, a fast tessellator, control
meshes with their readers, and the header for subjects of an audit.")

set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
# What Debian wants compressed.
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}/compress_documents.cmake")
include(CPack)
