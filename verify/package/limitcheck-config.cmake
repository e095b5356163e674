# SPDX-License-Identifier: MIT
# find_package(limitcheck [COMPONENTS subject data fast reference program]): each component looks for what it needs and for
# nothing else. Without COMPONENTS: all whose needs are met.
#   subject    limitcheck::subject     <limitcheck/subject.h>, in C or C++; needs nothing
#   data       limitcheck::data        control meshes, readers and writers; needs fmt
#   fast       limitcheck::fast, limitcheck::row_stream   the tessellators; needs data, TBB, Highway
#   reference  limitcheck::reference, limitcheck::reference_numbers   the exact surface; needs data, FLINT, Arb, MPFR, GMP
#   program    limitcheck::program and limitcheck_add_audit() (limitcheck-program.cmake); needs the program, which has a
#              package of its own
include(CMakeFindDependencyMacro)
set(limitcheck_known subject data fast reference program)
set(limitcheck_packages_data fmt)
set(limitcheck_packages_fast fmt TBB hwy)
set(limitcheck_packages_reference fmt)
set(limitcheck_libraries_reference flint-arb flint mpfr gmp)

find_program(limitcheck_program limitcheck HINTS ${CMAKE_CURRENT_LIST_DIR}/../../../bin ${CMAKE_CURRENT_LIST_DIR}/../../../../bin)
mark_as_advanced(limitcheck_program)

# Sets limitcheck_missing to what `component` needs and this machine has not.
macro(limitcheck_find_needs component)
  set(limitcheck_missing "")
  foreach(limitcheck_need IN LISTS limitcheck_packages_${component})
    find_package(${limitcheck_need} QUIET)
    if(NOT ${limitcheck_need}_FOUND)
      list(APPEND limitcheck_missing ${limitcheck_need})
    endif()
  endforeach()
  if("${component}" STREQUAL program AND NOT limitcheck_program)
    set(limitcheck_missing "the program limitcheck")
  endif()
  foreach(limitcheck_need IN LISTS limitcheck_libraries_${component})
    find_library(limitcheck_${limitcheck_need} ${limitcheck_need})
    mark_as_advanced(limitcheck_${limitcheck_need})
    if(NOT limitcheck_${limitcheck_need})
      list(APPEND limitcheck_missing ${limitcheck_need})
    endif()
  endforeach()
endmacro()

set(limitcheck_wanted ${limitcheck_FIND_COMPONENTS})
if(NOT limitcheck_wanted)
  set(limitcheck_wanted ${limitcheck_known})
endif()
if("fast" IN_LIST limitcheck_wanted OR "reference" IN_LIST limitcheck_wanted)
  list(PREPEND limitcheck_wanted data)
  list(REMOVE_DUPLICATES limitcheck_wanted)
endif()
foreach(limitcheck_component IN LISTS limitcheck_wanted)
  if(NOT limitcheck_component IN_LIST limitcheck_known)
    list(APPEND limitcheck_complaints "there is no component '${limitcheck_component}'")
    continue()
  endif()
  limitcheck_find_needs(${limitcheck_component})
  if(limitcheck_missing)
    list(JOIN limitcheck_missing ", " limitcheck_missing)
    list(APPEND limitcheck_complaints "component ${limitcheck_component} needs ${limitcheck_missing}")
    continue()
  endif()
  include(${CMAKE_CURRENT_LIST_DIR}/limitcheck-${limitcheck_component}.cmake)
  set(limitcheck_${limitcheck_component}_FOUND TRUE)
endforeach()
if(limitcheck_FIND_COMPONENTS AND limitcheck_complaints)
  list(JOIN limitcheck_complaints "; " limitcheck_NOT_FOUND_MESSAGE)
  set(limitcheck_FOUND FALSE)
endif()
unset(limitcheck_complaints)
