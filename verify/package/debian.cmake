# SPDX-License-Identifier: MIT
# `cpack` in the build folder: limitcheck_VERSION_ARCHITECTURE.deb. Needs dpkg-dev and file.
set(CPACK_GENERATOR DEB)
# The maintainer is whoever builds the package and answers for it; the field must not be empty.
set(LIMITCHECK_PACKAGE_CONTACT "whoever built this package <nobody@localhost>" CACHE STRING
  "Maintainer of the Debian package: NAME <ADDRESS>")
set(CPACK_PACKAGE_CONTACT "${LIMITCHECK_PACKAGE_CONTACT}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "judges tessellators of Loop and Catmull-Clark subdivision surfaces")
set(CPACK_PACKAGE_DESCRIPTION "It judges every point that a tessellator delivers against an exact
reference, looks for cracks bit by bit, and hands back each fault with a
witness. Tessellators are built in, or shared libraries and programs of the
user's own, or finished files. The package also holds the headers and static
libraries of the exact evaluator and of a fast tessellator.")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# For find_package(limitcheck COMPONENTS fast reference).
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
  "cmake, libfmt-dev, libtbb-dev, libhwy-dev, libflint-arb-dev, libflint-dev, libmpfr-dev, libgmp-dev, libboost-dev")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
# What Debian wants compressed.
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}/compress_documents.cmake")
include(CPack)
