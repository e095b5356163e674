#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Somebody whose program writes files: a right one, and one with a vertex out of place. Runs in an empty folder.
set -euo pipefail
limitcheck generate bumpy:20 -o cage.obj
limitcheck tessellate cage.obj --depth 3 -o fine.obj
limitcheck audit --control cage.obj --tessellation fine.obj

# One vertex 1/100 off: found at its place, in every form of the report, and again by the command that is printed.
awk '/^v / && ++n == 100 {$2 += 0.01} {print}' fine.obj >wrong.obj
code=0
limitcheck audit --control cage.obj --tessellation wrong.obj --json wrong.json --html wrong.html --junit wrong.xml \
  --witnesses found --tolerance 1e-5 >wrong.txt || code=$?
[[ $code == 1 ]]
grep -q 'file-distance' wrong.txt
python3 - <<'PYTHON'
import json, os, xml.etree.ElementTree as tree
report = json.load(open("wrong.json"))
bad = {row["check"] for row in report["results"] if row["status"] == "finding"}
assert "file-distance" in bad, bad
assert tree.parse("wrong.xml").getroot().findall(".//failure")
assert "wrong.obj" in open("wrong.html").read()
witness = [os.path.join(f, "witness.json") for f, _, files in os.walk("found") if "witness.json" in files]
assert witness
PYTHON
command=$(grep -o 'limitcheck audit --control.*' wrong.txt | head -1)
code=0
eval "$command" >again.txt || code=$?
[[ $code == 1 && $command == *"--tolerance 1e-05"* ]]

# Both, as subjects of one report.
limitcheck audit --control cage.obj --tessellation fine.obj --tessellation wrong.obj >both.txt || true
grep -q '^fine.obj  *held  *held  *held' both.txt
grep -q '^wrong.obj  *held  *held  *1/1' both.txt
