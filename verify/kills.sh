#!/bin/bash
# SPDX-License-Identifier: MIT
# Kills audit, hunt, mutants, prove and merge at random moments (SIGKILL) and resumes them, until each has been killed
# COUNT times: their reports must be those of runs that nobody killed, but for times.
#   verify/kills.sh PROGRAM [COUNT (40) [SEED (1)]]
set -u
program=$(realpath "$1"); count=${2:-40}; RANDOM=${3:-1}
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
cd "$folder"
declare -A command=(
  [audit]="audit naive tetrahedron octahedron icosahedron cube fan:5 --triangulate fan --depth 3 --json r.json"
  [hunt]="hunt row-stream --cases 6 --json r.json"
  [mutants]="mutants --shard 1/60 --json r.json"
  [prove]="prove --depth 0 --valences 3,5 --kernel sliding-window --json r.json"
  [merge]="merge part1.json part2.json -o r.json")

# The report without times, and without the digests that they change.
plain() {
  python3 - "$1" <<'PYTHON'
import json, sys
def drop(x):
    if isinstance(x, dict):
        return {k: drop(v) for k, v in x.items() if k not in ("seconds", "digest")}
    return [drop(v) for v in x] if isinstance(x, list) else x
print(json.dumps(drop(json.load(open(sys.argv[1]))), sort_keys=True))
PYTHON
}

# --resume, if there is what a kill has left; an empty journal is none. Jobs of a hunt end a moment after the process
# that was killed, and let go of their journals.
resume() {
  for journal in r.jsonl r.json.part*; do [[ -e $journal ]] && flock -w 60 "$journal" true; done
  find . -maxdepth 1 \( -name 'r.jsonl' -o -name 'r.json.part*' \) -empty -delete
  compgen -G 'r.jsonl' > /dev/null || compgen -G 'r.json.part*' > /dev/null && echo --resume
}

for k in 1 2; do "$program" ${command[audit]/r.json/part$k.json} --shard $k/2 > out 2>&1; done
wrong=0
for name in audit hunt mutants prove merge; do
  rm -f r.json*
  start=$(date +%s%N)
  "$program" ${command[$name]} > out 2>&1; code=$?
  took=$((($(date +%s%N) - start) / 1000000 + 1))
  plain r.json > "$name.whole"
  killed=0 compared=0
  rm -f r.json*
  while ((killed < count)); do
    "$program" ${command[$name]} $(resume) > out 2>&1 &
    pid=$!
    sleep "$(printf '%d.%03d' $((RANDOM % took / 1000)) $((RANDOM % took % 1000)))"
    if kill -KILL $pid 2> /dev/null; then
      wait $pid 2> /dev/null; ended=$?
      ((ended == 137)) && { ((++killed)); continue; }
    else
      wait $pid; ended=$?
    fi
    # It was quicker than the signal.
    ((ended == code)) || { echo "$name: exit code $ended, not $code"; cat out; ((++wrong)); }
    plain r.json | cmp -s - "$name.whole" || { echo "$name: another report"; ((++wrong)); }
    ((++compared)); rm -f r.json*
  done
  rm -f r.json; "$program" ${command[$name]} $(resume) > out 2>&1; ended=$?
  ((ended == code)) || { echo "$name: exit code $ended, not $code"; cat out; ((++wrong)); }
  plain r.json | cmp -s - "$name.whole" || { echo "$name: another report"; ((++wrong)); }
  echo "$name: killed $killed times in runs of $took ms, $((compared + 1)) reports compared"
done
exit $((wrong > 0))
