#!/bin/bash
# SPDX-License-Identifier: MIT
# Plants the faults of source_faults.txt in the kernels' own sources, one at a time, in a copy, and asks the proof.
# usage: verify/proof/source_faults.sh BUILD_DIRECTORY     (a built tree; some 10 s a fault)
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
  g++ "${flags[@]}" -c "$copy/verify/proof/prove_map_residues.cpp" -o "$copy/mutant.o" 2> "$copy/log" &&
    g++ "$copy/probe.o" "$copy/mutant.o" -Wl,--start-group "${libraries[@]}" -Wl,--end-group -o "$copy/probe" &&
    timeout 120 "$copy/probe"
}

if ! ask; then
  cat "$copy/log"
  echo "the proof fails without a fault"
  exit 1
fi
planted=0 missed=0
while IFS= read -r line; do
  [[ $line == '#'* || -z $line ]] && continue
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
  if answer=$(ask 2>&1); then
    missed=$((missed + 1))
    echo "MISSED     $file: $new"
  else
    echo "caught     $file: $new  ->  ${answer:-does not compile}"
  fi
  cp "$root/$file" "$copy/$file"
done < "$root/verify/proof/source_faults.txt"
echo "$((planted - missed)) of $planted faults caught"
exit "$missed"
