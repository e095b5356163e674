#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing, builds the release program and runs it.
#   bash verify/run.sh                 the main job: audit the built-in subjects; one screen, and build/report
#   bash verify/run.sh ARGUMENTS...    limitcheck ARGUMENTS..., run in the caller's folder
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
bash "$top/verify/install.sh"
testing=OFF
if [[ ${1:-} == claims || ${1:-} == reproduce ]]; then testing=ON; fi  # the claims are tests
bash "$top/verify/build.sh" release -DBUILD_TESTING=$testing
if [[ $# -gt 0 ]]; then
  exec "$top/build/release/limitcheck" "$@"
fi
cd "$top"
echo "Auditing the built-in tessellators (four minutes on two cores) ..." >&2
code=0
build/release/limitcheck audit || code=$?
case $code in
  0) echo "Exit code 0: nothing is wrong." ;;
  1) echo "Exit code 1: the audit ran to its end and has findings, those above. Some of the tessellators are known to be wrong." ;;
  *) echo "Exit code $code: the audit did not run to its end." ;;
esac
exit $code
