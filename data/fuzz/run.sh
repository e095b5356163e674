#!/bin/bash
# SPDX-License-Identifier: MIT
# Fuzzes every reader for SECONDS (default 150) from the wellformed and malformed files: bash data/fuzz/run.sh [SECONDS]
# What it learns stays in build/fuzz/corpus; a finding is written to build/fuzz/findings and makes the exit code 1.
set -eu
cd "$(dirname "$0")/../.."
seconds=${1:-150}
[ -f build/fuzz/build.ninja ] || cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --target fuzz_read_obj fuzz_read_off fuzz_read_ply fuzz_read_stl >/dev/null

mkdir -p build/fuzz/findings
status=0
for format in obj off ply stl; do
  mkdir -p "build/fuzz/corpus/$format"
  echo "fuzz_read_$format, $seconds s:"
  "build/fuzz/data/fuzz/fuzz_read_$format" -max_total_time="$seconds" -malloc_limit_mb=256 -timeout=10 -max_len=8192 \
    -artifact_prefix="build/fuzz/findings/$format-" "build/fuzz/corpus/$format" data/wellformed data/malformed \
    >"build/fuzz/$format.log" 2>&1 || status=1
  tail -n 1 "build/fuzz/$format.log"
done
exit $status
