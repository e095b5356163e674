#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing, builds the release program and its tests, and passes them all.
#   bash verify/test.sh [ctest arguments, for example -R Stam]
set -euo pipefail
cd "$(dirname "$0")/.."
bash verify/install.sh
bash verify/build.sh release -DBUILD_TESTING=ON ${CI:+-DLIMITCHECK_WERROR=ON}
exec ctest --test-dir build/release --output-on-failure -j "$(nproc)" "$@"
