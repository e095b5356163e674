#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Plants the faults of source_faults.txt in the sources of the projection, one at a time, in a copy, and runs the
# tests meant for them.
# usage: verify/projection/source_faults.sh BUILD_DIRECTORY [PATTERN]   (a built tree with tests; some 20 s a fault;
# only the lines that match PATTERN)
# Exit code 0: every fault was caught by its test; otherwise the number that were not.
set -u
root=$(cd "$(dirname "$0")/../.." && pwd)
build=$(cd "$1" && pwd)
here=$build/verify/projection
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT

# The program of the tests, with one source compiled anew: its object stands before the library's.
link() {
  g++ "$here"/CMakeFiles/projection_test.dir/*.o "$copy/mutant.o" -Wl,--start-group "$here/liblimitcheck_projection.a" \
    "$build/verify/audit/liblimitcheck_audit.a" "$build/verify/interrupt/liblimitcheck_interrupt.a" \
    "$build/reference/liblimitcheck_reference.a" "$build"/data/*.a -Wl,--end-group \
    -lgtest_main -lgtest -lfmt -ltbb -lmpfr -lgmp -lflint -lflint-arb -o "$copy/tests"
}

planted=0 missed=0
while IFS= read -r line; do
  [[ $line == '#'* || -z $line || $line != *"${2:-}"* ]] && continue
  file=${line%% | *} rest=${line#* | }
  old=${rest%% | *} rest=${rest#* | }
  new=${rest% | *} test=${rest##* | }
  text=$(< "$root/verify/projection/$file")
  planted=$((planted + 1))
  if [[ $text != *"$old"* ]]; then
    echo "NOT FOUND  $file: $old" && missed=$((missed + 1)) && continue
  fi
  printf '%s\n' "${text/"$old"/"$new"}" > "$copy/$file"
  if ! g++ -std=c++20 -O2 -ffp-contract=off -I "$root" -c "$copy/$file" -o "$copy/mutant.o" 2> "$copy/log" ||
     ! link 2> "$copy/log"; then
    echo "NO ANSWER  $file: $new" && tail -3 "$copy/log" && missed=$((missed + 1)) && continue
  fi
  timeout 120 "$copy/tests" --gtest_filter="$test*" > "$copy/answer" 2>&1
  case $? in
    0) echo "MISSED     $file: $new" && missed=$((missed + 1)) ;;
    124) echo "caught     $file: $new  ->  $test: never ends" ;;
    *) echo "caught     $file: $new  ->  $(grep -m 1 '^\[  FAILED  \]' "$copy/answer" | sed 's/.*\] //; s/ (.*//')" ;;
  esac
done < "$root/verify/projection/source_faults.txt"
echo "$((planted - missed)) of $planted faults caught"
exit "$missed"
