#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The tests under a sanitizer, with g++ or with clang, and under valgrind:
#   verify/sanitize.sh asan-ubsan[-clang] [ctest arguments]   addresses, leaks and undefined behaviour: all tests
#   verify/sanitize.sh program [ctest arguments]              the same of the libraries, and of the program where hostile
#                                                             meshes, files, libraries and programs are handed to it
#   verify/sanitize.sh tsan[-clang] [ctest arguments]         data races: the tests of the folders that use threads
#   verify/sanitize.sh valgrind [--gtest_filter=...]          memcheck: the tests of the libraries, and quick audits
# Left out, and why: under asan and tsan the subject that writes where it must not, on purpose, and with it into the
# sanitizer's own memory; in a program of its own (`program`) all libraries that break memory on purpose, which the
# sanitizer would tell first, and two tests that limit or measure the address space, of which it reserves 20 TB. Under
# tsan data/ and reference/, which use no threads, the tests that sample the running
# program by a timer's signals, which tsan holds back, and ten million points, which take it some ten minutes. Under
# valgrind AVX-512, which 3.19 lacks. Under tsan and valgrind the test that counts allocations by an operator new of
# its own, where they have theirs.
set -euo pipefail
cd "$(dirname "$0")/.."
kind=${1:?asan-ubsan, asan-ubsan-clang, program, tsan, tsan-clang or valgrind}
shift
bash verify/install.sh --dev

# oneTBB synchronises within its library. Uninstrumented, all that passes from thread to thread looks like a race;
# so the same version is built with the sanitizer of the same compiler, from Debian's source.
instrumented_tbb() {
  local compiler=$1 top=$PWD/build/tsan-tbb
  if [[ ! -e $top/$compiler/libtbb.so.12 ]]; then
    (
      options=(-q -o "Dir::Etc::sourcelist=$top/source.list" -o Dir::Etc::sourceparts=- -o "Dir::State::Lists=$top/lists")
      if [[ ! -e $top/source/CMakeLists.txt ]]; then
        mkdir -p "$top/lists/partial"
        cd "$top"
        echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian bookworm main" \
          >source.list
        apt-get "${options[@]}" update
        apt-get "${options[@]}" source --download-only onetbb
        tar xf onetbb_*.orig.tar.xz --one-top-level=source --strip-components=1
      fi
      cmake -G Ninja -S "$top/source" -B "$top/build-$compiler" -DCMAKE_CXX_COMPILER="$compiler" \
        -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1" \
        -DTBB_SANITIZE=thread -DTBB_TEST=OFF -DTBB_STRICT=OFF -DTBBMALLOC_BUILD=OFF -DTBB_DISABLE_HWLOC_AUTOMATIC_SEARCH=ON
      cmake --build "$top/build-$compiler" --target tbb
      mkdir -p "$top/$compiler"
      cp -P "$top/build-$compiler"/*/libtbb.so* "$top/$compiler"
    ) >&2
  fi
  echo "$top/$compiler"
}

# The tests in a folder of the build, but those whose names match a pattern.
tests_of() {
  local folder=$1 but=$2
  shift 2
  ctest --test-dir "$folder" --output-on-failure -j "$(nproc)" -E "$but" "$@"
}

case $kind in
  asan-ubsan | asan-ubsan-clang)
    bash verify/build.sh "$kind"
    export ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1 UBSAN_OPTIONS=print_stacktrace=1
    tests_of "build/$kind" 'Hostile.*/wild_write' "$@"
    ;;
  program)
    folders=(data reference fast verify/cli verify/files verify/host/isolation)
    cmake --preset asan-ubsan -DLIMITCHECK_VERIFY=ON -DBUILD_TESTING=ON >/dev/null
    cmake --build --preset asan-ubsan --target limitcheck "${folders[@]/%//all}" >&2
    # Programs that crash on purpose are to end by the signal.
    export ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1:handle_segv=0
    export UBSAN_OPTIONS=print_stacktrace=1 LSAN_OPTIONS=suppressions=$PWD/verify/lsan.suppressions:print_suppressions=0
    for folder in "${folders[@]}"; do
      tests_of "build/asan-ubsan/$folder"         'Hostile|Behaviours.OfLibraries|Process.OfALauncherKnows|Process.OfAForkedProgram' "$@"
    done
    ;;
  tsan | tsan-clang)
    bash verify/build.sh "$kind"
    compiler=g++
    [[ $kind == tsan ]] || compiler=clang++
    tbb=$(instrumented_tbb "$compiler")
    export LD_LIBRARY_PATH=$tbb TSAN_OPTIONS="suppressions=$PWD/verify/tsan.suppressions"
    for folder in fast verify; do
      tests_of "build/$kind/$folder" 'Hostile.*/wild_write|Targets.Only|SharedBits.AreEqualAtTenMillionPoints' "$@"
    done
    ;;
  valgrind)
    memcheck=(valgrind -q --error-exitcode=99 --leak-check=full --show-leak-kinds=definite
      --errors-for-leak-kinds=definite)
    bash verify/build.sh libraries
    find build/libraries/{data,reference,fast} -name '*_test' ! -name fast_allocation_test -type f -executable -print0 |
      xargs -0 -P "$(nproc)" -I{} "${memcheck[@]}" {} --gtest_brief=1 "$@"
    bash verify/build.sh release -DBUILD_TESTING=OFF
    for subject in row-stream:target={avx2,avx2/4,sse4,scalar} sliding-window opensubdiv-far:precision=double; do
      echo "$subject:"
      "${memcheck[@]}" build/release/limitcheck audit "$subject" icosahedron --depth 2 --level quick --details | tail -n 1
    done
    ;;
  *)
    echo "verify/sanitize.sh: asan-ubsan, asan-ubsan-clang, program, tsan, tsan-clang or valgrind, not '$kind'" >&2
    exit 2
    ;;
esac
