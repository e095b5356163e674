# SPDX-License-Identifier: MIT
# find_package(limitcheck): limitcheck::subject, the header <limitcheck/subject.h>.
include(${CMAKE_CURRENT_LIST_DIR}/limitcheck-subject.cmake)
