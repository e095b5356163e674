#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The tests under a sanitizer:
#   verify/sanitize.sh asan-ubsan [ctest arguments]   addresses and undefined behaviour, all tests
#   verify/sanitize.sh tsan [ctest arguments]         data races, the tests that use threads
#   verify/sanitize.sh valgrind                       memcheck: the quick audit on every target that valgrind can run
# Left out, and why: under tsan the tests that use no threads; under valgrind AVX-512, which valgrind 3.19 lacks.
set -euo pipefail
cd "$(dirname "$0")/.."
kind=${1:?asan-ubsan, tsan or valgrind}
shift
bash verify/install.sh --dev

# oneTBB synchronises within its library. Uninstrumented, all that passes from thread to thread looks like a race;
# so the same version is built with the sanitizer, from Debian's source.
instrumented_tbb() {
  local top=$PWD/build/tsan-tbb
  if [[ ! -e $top/lib/libtbb.so.12 ]]; then
    mkdir -p "$top/lists/partial" "$top/lib"
    echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian bookworm main" \
      >"$top/source.list"
    (
      cd "$top"
      options=(-q -o "Dir::Etc::sourcelist=$top/source.list" -o Dir::Etc::sourceparts=- -o "Dir::State::Lists=$top/lists")
      apt-get "${options[@]}" update
      apt-get "${options[@]}" source --download-only onetbb
      tar xf onetbb_*.orig.tar.xz --one-top-level=source --strip-components=1
      cmake -G Ninja -S source -B build -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1" \
        -DTBB_SANITIZE=thread -DTBB_TEST=OFF -DTBB_STRICT=OFF -DTBBMALLOC_BUILD=OFF -DTBB_DISABLE_HWLOC_AUTOMATIC_SEARCH=ON
      cmake --build build --target tbb
      cp -P build/*/libtbb.so* lib/
    ) >&2
  fi
  echo "$top/lib"
}

case $kind in
  asan-ubsan)
    bash verify/build.sh asan-ubsan
    exec ctest --test-dir build/asan-ubsan --output-on-failure -j "$(nproc)" "$@"
    ;;
  tsan)
    bash verify/build.sh tsan
    tbb=$(instrumented_tbb)
    export LD_LIBRARY_PATH=$tbb TSAN_OPTIONS="suppressions=$PWD/verify/tsan.suppressions"
    [[ $# -gt 0 ]] || set -- -R 'Thread|Frame|Sinks|Depth|Isolation|Breakdown|Closest|Adapters|FileAudit|AuditCommand'
    exec ctest --test-dir build/tsan --output-on-failure -j "$(nproc)" "$@"
    ;;
  valgrind)
    bash verify/build.sh release -DBUILD_TESTING=OFF
    for subject in row-stream:target={avx2,avx2/4,sse4,scalar} sliding-window opensubdiv-far:precision=double; do
      echo "$subject:"
      valgrind -q --error-exitcode=99 --leak-check=full --show-leak-kinds=definite --errors-for-leak-kinds=definite \
        build/release/limitcheck audit "$subject" icosahedron --depth 2 --level quick | tail -n 1
    done
    ;;
  *)
    echo "verify/sanitize.sh: asan-ubsan, tsan or valgrind, not '$kind'" >&2
    exit 2
    ;;
esac
