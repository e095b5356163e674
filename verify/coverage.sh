#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Lines of data, reference and fast that their own tests run; red below the floor. The page: build/coverage/index.html
set -euo pipefail
cd "$(dirname "$0")/.."
floor=95
bash verify/install.sh --dev
bash verify/build.sh coverage -DBUILD_TESTING=ON
find build/coverage -name '*.gcda' -delete
ctest --test-dir build/coverage --output-on-failure -j "$(nproc)"
gcovr -r . build/coverage --filter 'data/' --filter 'reference/' --filter 'fast/' --exclude '.*_test\.cpp' \
  --exclude-throw-branches --html-details build/coverage/index.html --print-summary --fail-under-line "$floor"
