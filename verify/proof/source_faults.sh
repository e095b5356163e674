#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Plants the faults of source_faults.txt in the kernels' own sources, one at a time, in a copy, and asks the proof.
# usage: verify/proof/source_faults.sh BUILD_DIRECTORY [PATTERN]   (a built tree; 10 s or more a fault; only the
# lines that match PATTERN). Faults of the quads' window are shown to quad_map_test.cpp.
# Exit code 0: every fault was caught; otherwise the number that were not.
set -u
root=$(cd "$(dirname "$0")/../.." && pwd)
build=$(cd "$1" && pwd)
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
cp -r "$root"/{data,fast,reference,verify} "$copy"
libraries=("$build/verify/proof/liblimitcheck_proof.a" "$build/fast/liblimitcheck_fast.a"
  "$build/reference/liblimitcheck_reference.a" "$build/data/liblimitcheck_data.a"
  -lfmt -lmpfr -lgmp -lflint -lflint-arb -ltbb)
flags=(-std=c++20 -O1 -I "$copy" -ffp-contract=off)
g++ "${flags[@]}" -c "$copy/verify/proof/source_fault_probe.cpp" -o "$copy/probe.o" || exit 1

ask() {
  g++ "${flags[@]}" -c "$copy/verify/proof/maps/prove_map_residues.cpp" -o "$copy/mutant.o" 2> "$copy/log" || return 2
  g++ "$copy/probe.o" "$copy/mutant.o" -Wl,--start-group "${libraries[@]}" -Wl,--end-group -o "$copy/probe" || return 2
  timeout 300 "$copy/probe"
}

quad_sources=(verify/proof/maps/quad_map_test.cpp fast/mesh/adjacency.cpp fast/mesh/quad_mesh.cpp
  fast/mesh/sharp_polygons.cpp fast/rules/quad_limit.cpp fast/rules/semi_sharp.cpp)
ask_quads() {
  (cd "$copy" && g++ "${flags[@]}" "${quad_sources[@]}" -o probe -Wl,--start-group "${libraries[@]}" \
    "$build/data/liblimitcheck_generators.a" -Wl,--end-group -lgtest -lgtest_main) 2> "$copy/log" || return 2
  timeout 300 "$copy/probe" --gtest_brief=1 --gtest_fail_fast > "$copy/said"
  local status=$?
  grep -m 1 "^face" "$copy/said"
  return "$status"
}

if ! ask || ! ask_quads; then
  cat "$copy/log"
  echo "the proof fails without a fault"
  exit 1
fi
planted=0 missed=0
while IFS= read -r line; do
  [[ $line == '#'* || -z $line || $line != *"${2:-}"* ]] && continue
  file=${line%% | *} rest=${line#* | }
  old=${rest%% | *} new=${rest#* | }
  text=$(< "$root/$file")
  if [[ $text != *"$old"* ]]; then
    echo "NOT FOUND  $file: $old"
    missed=$((missed + 1))
    continue
  fi
  printf '%s\n' "${text/"$old"/"$new"}" > "$copy/$file"
  planted=$((planted + 1))
  case $file in
    *quad* | *sharp*) answer=$(ask_quads 2>&1) ;;
    *) answer=$(ask 2>&1) ;;
  esac
  case $? in
    1) echo "caught     $file: $new  ->  $answer" ;;
    0) echo "MISSED     $file: $new" && missed=$((missed + 1)) ;;
    *) echo "NO ANSWER  $file: $new" && missed=$((missed + 1)) ;;  # does not compile, or never ends
  esac
  cp "$root/$file" "$copy/$file"
done < "$root/verify/proof/source_faults.txt"
echo "$((planted - missed)) of $planted faults caught"
exit "$missed"
