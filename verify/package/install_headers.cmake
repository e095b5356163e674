# SPDX-License-Identifier: MIT
# At install time: copies HEADERS of SOURCE to DESTINATION/limitcheck with "data/x.h" included as "limitcheck/data/x.h". A
# user who has a data/ of his own gets ours all the same, and our headers never get his. SCRATCH: a folder to write to.
string(RANDOM LENGTH 12 unique)  # installations may run at the same time
set(copies "${SCRATCH}/headers-${unique}")
foreach(header IN LISTS HEADERS)
  file(READ "${SOURCE}/${header}" text)
  string(REGEX REPLACE "(#include \")((data|reference|fast)/)" "\\1limitcheck/\\2" text "${text}")
  file(WRITE "${copies}/limitcheck/${header}" "${text}")
endforeach()
# Where they lay in 0.1: "old new".
file(STRINGS "${SOURCE}/verify/package/moved_headers.txt" moved)
foreach(line IN LISTS moved)
  string(REPLACE " " ";" line "${line}")
  list(POP_FRONT line old new)
  file(WRITE "${copies}/limitcheck/${old}" "#pragma once\n#include \"limitcheck/${new}\"  // moved after 0.1\n")
endforeach()
file(INSTALL "${copies}/limitcheck" DESTINATION "${DESTINATION}")
file(REMOVE_RECURSE "${copies}")
