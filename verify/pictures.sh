#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes the pictures of the README anew: bash verify/pictures.sh
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for name in error sharp; do
  bash "$top/verify/run.sh" reproduce -o "$work" --only "picture-$name"
  python3 "$top/bench/report/half_size.py" "$work/picture-$name.png" "$top/.github/pictures/$name.png"
done
