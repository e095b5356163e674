#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Configures and builds a preset, with ccache if it is installed. Says on standard error what it does and how long it may still
# take: on a terminal in one line, elsewhere in a line every half a minute. Shows the whole log only if it fails.
#   verify/build.sh PRESET [--target NAME] [cmake arguments]
set -euo pipefail
cd "$(dirname "$0")/.."
preset=$1
shift
target=all
if [[ ${1:-} == --target ]]; then
  target=$2
  shift 2
fi
if command -v ccache >/dev/null; then
  set -- -DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache "$@"
fi

log=$(mktemp)
trap 'rm -f "$log"' EXIT
first=
if [[ ! -e build/$preset/build.ninja ]]; then
  first=yes
  echo "Configuring the preset $preset, and building it on $(nproc) cores ..." >&2
fi
cmake --preset "$preset" "$@" >"$log" 2>&1 || { cat "$log" >&2; exit 2; }

# ninja's lines begin with [12/345].
tell() {
  local between=30 next=0 steps seconds
  [[ -t 2 ]] && between=1
  SECONDS=0
  while sleep 1; do
    ((SECONDS >= next)) || continue
    next=$((SECONDS + between))
    steps=$(tail -c 4000 "$log" | tr '\r' '\n' | grep -oE '^\[[1-9][0-9]*/[0-9]+\]' | tail -n 1 | tr -d '[]') || continue
    seconds=$((SECONDS * (${steps#*/} - ${steps%/*}) / ${steps%/*}))
    if [[ -t 2 ]]; then
      printf '\r\033[K%s steps, about %d s left' "$steps" "$seconds" >&2
    else
      echo "$steps steps, about $seconds s left" >&2
    fi
  done
}
tell &
teller=$!
code=0
cmake --build --preset "$preset" --target "$target" >"$log" 2>&1 || code=2
kill "$teller" 2>/dev/null || true
[[ ! -t 2 ]] || printf '\r\033[K' >&2
[[ $code -eq 0 ]] || { cat "$log" >&2; exit 2; }
[[ -z $first ]] || echo "Built, in $SECONDS s." >&2
