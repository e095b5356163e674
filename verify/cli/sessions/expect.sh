# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# What the sessions beside this file are written in. sessions_test.cpp runs each of their functions whose name begins with a
# capital in an empty folder, where `limitcheck` is the program and $PROGRAM its file.
# shellcheck disable=SC2034,SC2154
failures=0 told=''
fail() {
  failures=1
  printf '%s, line %s: %s\n  after: limitcheck %s\n' "$session" "${BASH_LINENO[1]}" "$1" "$told"
  head -c 3000 out err
}
# CODE ARGUMENTS..: runs the program, which must end with this exit code. What it says is then in the files out and err.
run() {
  local code=0
  told="${*:2}"
  limitcheck "${@:2}" >out 2>err </dev/null || code=$?
  [[ $code == "$1" ]] || fail "exit code $code, not $1"
}
# CODE [CHECK WORDS..]: the same for each line of standard input, as a shell has it, with a check of these behind it.
each() {
  local line
  while read -r line; do
    eval "run $1 $line"
    [[ $# == 1 ]] || "${@:2}"
  done
}
# COMMAND: with the arguments of each line it ends with 2, says why and does nothing else.
refused() {
  local line
  while read -r line; do
    eval "run 2 $1 $line"
    [[ -s err && ! -s out ]] || fail 'says nothing on standard error, or something on standard output'
  done
}
# WORDS..: are what standard output or error has, or has not; first: is its first line.
out() { for w; do [[ $(<out) == *"$w"* ]] || fail "does not say: $w"; done; }
err() { for w; do [[ $(<err) == *"$w"* ]] || fail "does not complain: $w"; done; }
lacks() { for w; do [[ $(<out) != *"$w"* ]] || fail "says: $w"; done; }
first() { [[ $(head -n 1 "${2:-out}") == "$1" ]] || fail "does not begin with: $1"; }
silent() { [[ ! -s err ]] || fail 'says something on standard error'; }
nothing() { [[ ! -s out ]] || fail 'says something on standard output'; }
# CONDITION..: of `test`.
holds() { test "$@" || fail "not: $*"; }
# FILE EXPRESSION..: in Python, of the JSON r in the file, with its rows and the first of a check, and load(FILE). json: all are
# true; value: prints one, each element of a list on a line.
python() {
  /usr/bin/python3 - "$@" <<'PYTHON'
import json, sys
load = lambda file: json.load(open(file))
r = load(sys.argv[2])
rows = r.get("results", []) if isinstance(r, dict) else []
row = lambda check, **more: next(x for x in rows if x["check"] == check and all(x[k] == v for k, v in more.items()))
near = lambda a, b: len(a) == len(b) > 0 and all(abs(float(x) - float(y)) < 1e-14 for x, y in zip(a, b))
for expression in sys.argv[3:]:
    is_so = eval(expression, globals())
    if sys.argv[1] == "value":
        for line in is_so if isinstance(is_so, list) else [is_so]:
            print(line)
    elif not is_so:
        sys.exit(f"not: {expression}\n")
PYTHON
}
json() { python json "$@" || fail "of $1"; }
value() { python value "$@"; }
