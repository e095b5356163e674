#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Configures and builds a preset; shows progress on a terminal, and the whole log only if it fails.
#   verify/build.sh PRESET [cmake arguments]
set -euo pipefail
cd "$(dirname "$0")/.."
preset=$1
shift

log=$(mktemp)
trap 'rm -f "$log"' EXIT
cmake --preset "$preset" "$@" >"$log" 2>&1 || { cat "$log" >&2; exit 2; }
if [[ -t 2 ]]; then
  cmake --build --preset "$preset" >&2 || exit 2
else
  cmake --build --preset "$preset" >"$log" 2>&1 || { cat "$log" >&2; exit 2; }
fi
