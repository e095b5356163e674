# SPDX-License-Identifier: MIT
# The program, and audits of a project's own tessellator as its tests.
if(NOT TARGET limitcheck::program)
  add_executable(limitcheck::program IMPORTED)
  set_target_properties(limitcheck::program PROPERTIES IMPORTED_LOCATION "${limitcheck_program}")
endif()

# limitcheck_add_audit(TARGET [NAME NAME] [ARGUMENTS WORD...]): a test of CTest, audit_TARGET unless it has a NAME, that
# audits what TARGET builds: a shared library or module that exports limitcheck_subject(), or a program that speaks the
# protocol of lines. It passes if nothing is found. The ARGUMENTS are those of `limitcheck audit` behind SUBJECT: meshes
# and options; without any the default meshes are looked at, which takes minutes.
function(limitcheck_add_audit target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "NAME" "ARGUMENTS")
  if(NOT TARGET ${target} OR arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "limitcheck_add_audit(${ARGV}): TARGET [NAME NAME] [ARGUMENTS WORD...]")
  endif()
  if(NOT arg_NAME)
    set(arg_NAME audit_${target})
  endif()
  add_test(NAME ${arg_NAME} COMMAND limitcheck::program audit $<TARGET_FILE:${target}> ${arg_ARGUMENTS})
endfunction()
