#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Configures and builds a preset. Says on standard error what it does, with progress on a terminal, and shows the whole log only
# if it fails.
#   verify/build.sh PRESET [cmake arguments]
set -euo pipefail
cd "$(dirname "$0")/.."
preset=$1
shift

log=$(mktemp)
trap 'rm -f "$log"' EXIT
first=
if [[ ! -e build/$preset/build.ninja ]]; then
  first=yes
  echo "Configuring the preset $preset, and building it on $(nproc) cores: ten minutes on two, the first time ..." >&2
fi
cmake --preset "$preset" "$@" >"$log" 2>&1 || { cat "$log" >&2; exit 2; }
if [[ -t 2 ]]; then
  cmake --build --preset "$preset" >&2 || exit 2
else
  cmake --build --preset "$preset" >"$log" 2>&1 || { cat "$log" >&2; exit 2; }
fi
[[ -z $first ]] || echo "Built, in $SECONDS s." >&2
