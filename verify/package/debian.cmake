# SPDX-License-Identifier: MIT
# `cpack` in the build folder: limitcheck_VERSION_ARCHITECTURE.deb. Needs dpkg-dev and file.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The limitcheck authors <limitcheck@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "judges tessellators of Loop subdivision surfaces")
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
