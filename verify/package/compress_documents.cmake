# SPDX-License-Identifier: MIT
# Within cpack: the manual page and the change log, compressed as Debian's policy asks.
foreach(document share/man/man1/limitcheck.1 share/doc/limitcheck/changelog)
  execute_process(COMMAND gzip -9nf "${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr/${document}" COMMAND_ERROR_IS_FATAL ANY)
endforeach()
