#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Plants the faults of source_faults.txt in the kernels' own sources, one at a time, in a copy, and asks what must
# find them: the finder that the line names, or "quads" for the sources of quads and of sharp edges, else "map".
# usage: verify/proof/source_faults.sh BUILD_DIRECTORY [PATTERN]   (a built tree; 10 s or more a fault; only the
# lines that match PATTERN). Exit code 0: every fault was caught; otherwise the number that were not.
set -u
root=$(cd "$(dirname "$0")/../.." && pwd)
build=$(cd "$1" && pwd)
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
cp -r "$root"/{data,fast,reference,verify} "$copy"
mkdir "$copy"/{objects,faulty}
libraries=("$build/verify/proof/liblimitcheck_proof.a" "$build/fast/stream/liblimitcheck_row_stream.a"
  "$build/fast/liblimitcheck_fast.a" "$build/reference/liblimitcheck_reference.a"
  "$build/data/liblimitcheck_data.a" "$build/data/liblimitcheck_generators.a"
  -lfmt -lmpfr -lgmp -lflint -lflint-arb -ltbb -lhwy)
flags=(-std=c++20 -I "$copy" -ffp-contract=off -MD)

# What a finder is made of: a program or a test, and the sources that faults are planted in or that include them.
declare -A sources=(
  [map]="verify/proof/test_source_fault.cpp verify/proof/maps/prove_map_residues.cpp"
  [quads]="verify/proof/maps/map_test.cpp verify/proof/maps/prove_map_exact.cpp verify/proof/maps/prove_map_digits.cpp
    fast/mesh/adjacency.cpp fast/mesh/cut_mesh.cpp fast/rules/quad_limit.cpp fast/rules/semi_sharp.cpp"
  [shipped]="verify/proof/bounds/bounds_test.cpp verify/proof/bounds/shipped_kernels.cpp fast/stream/kernel/targets.cpp
    fast/stream/kernel/quad_targets.cpp fast/stream/gather/rings.cpp fast/rules/quad_limit.cpp"
  [bits]="fast/stream/host/row_stream_test.cpp fast/stream/gather/rings.cpp"
  [quadbits]="fast/stream/host/quad_row_stream_test.cpp fast/stream/host/row_stream.cpp fast/stream/gather/rings.cpp
    fast/stream/kernel/quad_targets.cpp"
  [parts]="fast/stream/host/frame_test.cpp fast/window/tessellator.cpp fast/plan/crack.cpp"
  [darts]="fast/rules/ring_test.cpp fast/rules/quad_limit.cpp")

# compile FINDER FOLDER FILE: its objects, into the folder those alone that depend on the file.
compile() {
  local source object
  for source in ${sources[$1]}; do
    object=${source//\//_}
    if [ -n "$3" ]; then
      rm -f "$copy/faulty/$object.o"
      grep -q -F -- "$copy/$3" "$copy/objects/$object.d" || continue
    elif [ -e "$copy/objects/$object.o" ]; then
      continue
    fi
    # The vector targets take long to optimise, and little to run.
    g++ "${flags[@]}" "$([ "$1" = shipped ] && echo -O0 || echo -O1)" -c "$copy/$source" -o "$copy/$2/$object.o" 2> "$copy/log" || return 2
  done
}

# ask FINDER [FILE]: builds what depends on the file, and runs the finder. 0: nothing found; 1: found.
ask() {
  local finder=$1 file=${2:-} source object objects=()
  compile "$finder" objects "" || return 2
  [ -z "$file" ] || compile "$finder" faulty "$file" || return 2
  for source in ${sources[$finder]}; do
    object=${source//\//_}.o
    [ -n "$file" ] && [ -e "$copy/faulty/$object" ] && objects+=("$copy/faulty/$object") && continue
    objects+=("$copy/objects/$object")
  done
  g++ "${objects[@]}" -Wl,--start-group "${libraries[@]}" -Wl,--end-group -lgtest -lgtest_main \
    -o "$copy/probe" 2> "$copy/log" || return 2
  (cd "$copy" && timeout 300 ./probe --gtest_brief=1 --gtest_fail_fast > said 2>&1)
  local status=$?
  grep -m 1 -E "^face| on |FAILED  \]" "$copy/said" || head -n 1 "$copy/said"
  [ "$status" -gt 128 ] && echo "it crashes" && return 1
  return "$status"
}

declare -A sound=()
planted=0 missed=0
while IFS= read -r line; do
  [[ $line == '#'* || -z $line || $line != *"${2:-}"* ]] && continue
  file=${line%% | *} rest=${line#* | }
  old=${rest%% | *} new=${rest#* | }
  case $file in
    *quad* | *sharp*) finder=quads ;;
    *) finder=map ;;
  esac
  [[ $new == *" | by "* ]] && finder=${new##* | by } new=${new%" | by "*}
  text=$(< "$root/$file")
  if [[ $text != *"$old"* ]]; then
    echo "NOT FOUND  $file: $old"
    missed=$((missed + 1))
    continue
  fi
  if [ -z "${sound[$finder]:-}" ]; then
    if ! ask "$finder" > /dev/null; then
      cat "$copy/log" "$copy/said"
      echo "$finder fails without a fault"
      exit 1
    fi
    sound[$finder]=1
  fi
  printf '%s\n' "${text/"$old"/"$new"}" > "$copy/$file"
  planted=$((planted + 1))
  answer=$(ask "$finder" "$file" 2>&1)
  case $? in
    1) echo "caught     $file: $new  ->  $finder: $answer" ;;
    0) echo "MISSED     $file: $new  ($finder)" && missed=$((missed + 1)) ;;
    *) echo "NO ANSWER  $file: $new  ($finder)" && missed=$((missed + 1)) ;;  # does not compile, or never ends
  esac
  cp "$root/$file" "$copy/$file"
done < "$root/verify/proof/source_faults.txt"
echo "$((planted - missed)) of $planted faults caught"
exit "$missed"
