#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Style and static analysis.
#   bash verify/lint.sh --format      format and spelling (seconds)
#   bash verify/lint.sh --quick       and cppcheck (a minute)
#   bash verify/lint.sh --libraries   and clang-tidy on the sources of data, reference and fast (some minutes)
#   bash verify/lint.sh               and on all others (half an hour on two cores)
set -euo pipefail
cd "$(dirname "$0")/.."
bash verify/install.sh --dev

git ls-files -z '*.h' '*.cpp' '*.c' | xargs -0 clang-format --dry-run -Werror
# Names of the field and of file formats that look like slips of the pen; one test misspells on purpose.
git ls-files -z ':!data/known_answers.json' ':!verify/fuzz/seeds' ':!data/malformed' ':!bench/report/package-lock.json' | xargs -0 codespell --ignore-words-list lod,parm,fo,ot,daa,bund,kown,inout
[[ ${1:-} == --format ]] && exit 0

# Not true of: a constant that a derived number gives another value, on purpose; arrays filled where they are used; if
# constexpr that covers every case; pointers that are compared as addresses.
cppcheck --quiet --std=c++20 --language=c++ --enable=warning,portability --error-exitcode=1 -j "$(nproc)" -I . \
  --template='{file}:{line}: {id}: {message}' --suppress=unknownMacro --suppress=duplInheritedMember \
  --suppress=uninitMemberVar:fast/window/crack_edge.h --suppress=missingReturn:fast/stream/kernel/strip-inl.h \
  --suppress=CastIntegerToAddressAtReturn:fast/stream/kernel/stream-inl.h \
  --suppress=CastIntegerToAddressAtReturn:fast/stream/kernel/quad_stream-inl.h \
  --suppress=mismatchingContainerExpression:verify/host/tessellation.cpp \
  $(git ls-files '*.cpp' ':!*_test.cpp' ':!*/fuzz/*')
[[ ${1:-} == --quick ]] && exit 0

cmake --preset release -DBUILD_TESTING=ON >/dev/null
folders='data|reference|fast|verify|bench'
[[ ${1:-} == --libraries ]] && folders='data|reference|fast'
mapfile -t sources < <(git ls-files '*.cpp' ':!*_test.cpp' ':!*_fuzz.cpp' ':!verify/package/test_package' \
  ':!verify/subject/examples' | grep -E "^($folders)/")
printf '%s\0' "${sources[@]}" | xargs -0 -n 1 -P "$(nproc)" \
  clang-tidy -quiet -p build/release -extra-arg=-Wno-unknown-warning-option 2>/dev/null
