# SPDX-License-Identifier: MIT
# The manual page: limitcheck.1.in with what --help says. Run by the build with PROGRAM, FRAME, VERSION and PAGE.
set(ENV{COLUMNS} 72)
cmake_path(GET PROGRAM PARENT_PATH folder)
function(append_help)
  execute_process(COMMAND ./limitcheck ${ARGV} --help WORKING_DIRECTORY ${folder} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "./limitcheck" "limitcheck" text "${text}")
  if(NOT ARGV)
    string(REGEX MATCHALL "\n  [a-z]+  " commands "${text}")
    set(commands "${commands}" PARENT_SCOPE)
  endif()
  # As troff takes it: a '-' that can be copied, a '.' that begins no request.
  string(REPLACE "\\" "\\e" text "${text}")
  string(REPLACE "-" "\\-" text "${text}")
  string(REGEX REPLACE "\n([.'])" "\n\\\\&\\1" text "${text}")
  string(STRIP "limitcheck ${ARGV}" title)
  set(HELP "${HELP}.SS ${title}\n.nf\n${text}.fi\n" PARENT_SCOPE)
endfunction()

append_help()
foreach(command IN LISTS commands)
  string(STRIP "${command}" command)
  if(NOT command MATCHES "^(bench|reproduce|shader)$")  # programs of their own
    append_help(${command})
  endif()
endforeach()
configure_file(${FRAME} ${PAGE} @ONLY)
