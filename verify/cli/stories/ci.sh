#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Somebody who keeps a tessellator: what is known does not fail the build, what gets worse or is new does. Runs in an
# empty folder.
set -euo pipefail
audit() {
  limitcheck audit "faulty:fault=$1,of=model" icosahedron --depth 2 --level quick "${@:2}"
}
run() { # EXIT_CODE COMMAND...
  local code=0
  "${@:2}" >out.txt 2>&1 || code=$?
  [[ $code == "$1" ]] || { echo "$* ended with $code"; cat out.txt; exit 1; }
}
# The tessellator has one fault, which is known; nothing changes.
run 1 audit wrong_limit_mask --save-baseline known.txt --json before.json
run 0 audit wrong_limit_mask --baseline known.txt
run 0 audit wrong_limit_mask --baseline before.json

# A change makes it worse: the same subject, as the file door knows it by its file's name.
limitcheck generate icosahedron -o cage.obj
limitcheck tessellate cage.obj --depth 2 -o fine.obj
awk '/^v / && ++n == 50 {$2 += 0.0001} {print}' fine.obj >mine.obj
run 1 limitcheck audit --control cage.obj --tessellation mine.obj --save-baseline mine.txt
run 0 limitcheck audit --control cage.obj --tessellation mine.obj --baseline mine.txt
awk '/^v / && ++n == 50 {$2 += 0.01} {print}' fine.obj >mine.obj
run 1 limitcheck audit --control cage.obj --tessellation mine.obj --baseline mine.txt --sarif log.sarif --markdown page.md
grep -q ' -> ' out.txt
grep -q 'worse' out.txt
python3 -c "import json; log = json.load(open('log.sarif')); assert log['version'] == '2.1.0' and log['runs'][0]['results']"
grep -q '^|' page.md

# Only what had findings, again.
run 1 limitcheck audit --rerun before.json
grep -q 'still there' out.txt
