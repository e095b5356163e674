# SPDX-License-Identifier: MIT
# Writes HEADER: LIMITCHECK_COMMIT is " (commit)", and empty where SOURCE is no working tree of git.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12 --exclude=*
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
set(text "")
if(NOT failed AND EXISTS ${SOURCE}/.git)
  set(text " (${commit})")
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define LIMITCHECK_COMMIT \"@text@\"\n" @ONLY)
