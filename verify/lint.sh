#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Style and static analysis: clang-format on every source, clang-tidy on every translation unit of the release build.
#   bash verify/lint.sh            both
#   bash verify/lint.sh --format   the format only
set -euo pipefail
cd "$(dirname "$0")/.."
bash verify/install.sh --dev
git ls-files -z '*.h' '*.cpp' '*.c' | xargs -0 clang-format --dry-run -Werror
[[ ${1:-} == --format ]] && exit 0
cmake --preset release >/dev/null
run-clang-tidy -quiet -p build/release -j "$(nproc)" "$PWD/(data|reference|fast|verify|bench)/" 2>/dev/null
