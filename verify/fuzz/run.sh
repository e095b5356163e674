#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Fuzzes every target for SECONDS (default 150) from the seeds that are kept: bash verify/fuzz/run.sh [SECONDS [TARGET...]]
# Targets: read_obj read_off read_ply read_stl read_usda protocol waivers provenance gltf repair tags parts file_audit difference (default: all).
# Seeds and dictionaries: data/wellformed, data/malformed and data/fuzz for the readers, verify/fuzz for the others.
# What it learns stays in build/fuzz/corpus; a finding is written to build/fuzz/findings and makes the exit code 1.
set -euo pipefail
cd "$(dirname "$0")/../.."
seconds=${1:-150}
targets=("${@:2}")
[[ ${#targets[@]} -gt 0 ]] || targets=(read_obj read_off read_ply read_stl read_usda protocol waivers provenance gltf repair tags parts file_audit difference)

mkdir -p build/fuzz/findings
{ cmake --preset fuzz && cmake --build --preset fuzz --target "${targets[@]/#/fuzz_}"; } >build/fuzz/build.log 2>&1 ||
  { tail -n 40 build/fuzz/build.log; exit 1; }
status=0
for target in "${targets[@]}"; do
  program=$(find build/fuzz -type f -name "fuzz_$target" -perm -u+x)
  seeds=("verify/fuzz/seeds/$target")
  [[ $target == read_* ]] && seeds=(data/wellformed data/malformed)
  mkdir -p "build/fuzz/corpus/$target"
  dictionary=()
  for file in "verify/fuzz/dictionaries/$target.dict" "data/fuzz/$target.dict"; do
    [[ -e $file ]] && dictionary=("-dict=$file")
  done
  echo "fuzz_$target, $seconds s:"
  "$program" -max_total_time="$seconds" -malloc_limit_mb=512 -timeout=120 -max_len=8192 -print_final_stats=1 "${dictionary[@]}" \
    -artifact_prefix="build/fuzz/findings/$target-" "build/fuzz/corpus/$target" "${seeds[@]}" \
    >"build/fuzz/$target.log" 2>&1 || { status=1; tail -n 40 "build/fuzz/$target.log"; }
  grep -a ' cov: ' "build/fuzz/$target.log" | tail -n 1 || true
  grep -a 'number_of_executed_units' "build/fuzz/$target.log" || true
done
exit $status
