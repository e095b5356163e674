#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Audits the built-in tessellators and writes what came out to the table "What it found" of README.md.
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
bash "$top/verify/build.sh" release -DBUILD_TESTING=ON
cd "$top"
code=0
build/release/limitcheck audit --all-rows --report build/report || code=$?
[[ $code -le 1 ]]
LIMITCHECK_FINDINGS=$top/build/report/audit.json build/release/verify/cli/findings_test --gtest_filter='*Written*'
git diff --stat README.md
