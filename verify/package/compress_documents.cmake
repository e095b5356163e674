# SPDX-License-Identifier: MIT
# Within cpack: the manual page and the change logs, compressed as Debian's policy asks.
file(GLOB_RECURSE documents "${CPACK_TEMPORARY_INSTALL_DIRECTORY}/*/limitcheck.1" "${CPACK_TEMPORARY_INSTALL_DIRECTORY}/*/changelog")
execute_process(COMMAND gzip -9nf ${documents} COMMAND_ERROR_IS_FATAL ANY)
