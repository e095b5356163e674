#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing, builds the release program and runs it.
#   bash verify/run.sh                 the main job: audit the built-in subjects; one screen, and build/report
#   bash verify/run.sh ARGUMENTS...    limitcheck ARGUMENTS..., run in the caller's folder
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
bash "$top/verify/install.sh"
case ${1:-audit} in
  bench | claims | reproduce) target=all ;;  # the programs that these run; the claims are tests
  prove) target=limitcheck_prove ;;
  *) target=limitcheck ;;
esac
if [[ $target == all ]]; then echo "limitcheck $1 runs programs of bench/ and tests: all of the project is built." >&2; fi
bash "$top/verify/build.sh" release --target $target
if [[ $# -gt 0 ]]; then
  exec "$top/build/release/limitcheck" "$@"
fi
cd "$top"
# Some of the tessellators are known to be wrong: what is new or gone since that was written down is what counts.
echo "Auditing the built-in tessellators (six minutes on two cores) ..." >&2
known=verify/peers/known.txt
code=0
build/release/limitcheck audit --report build/report --baseline "$known" || code=$?
if [[ $code -gt 1 ]]; then
  echo "Exit code $code: the audit did not run to its end." >&2
  exit "$code"
fi
python3 - "$known" <<'END'
import json, sys

report = json.load(open("build/report/audit.json"))
changes = report["changes"]
other = changes["new"] + changes["worse"] + changes["gone"]
print(f"{len(report['causes'])} root causes, of tessellators that are known to be wrong.", end=" ")
if other:
    print(f"{other} findings are not as {sys.argv[1]} has them, those named above: exit code 1.")
else:
    print(f"Nothing is new, worse or gone since {sys.argv[1]} was written: exit code 0.")
sys.exit(1 if other else 0)
END
