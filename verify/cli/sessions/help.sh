# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# --help: examples that run, groups, and lines that fit the screen, as all output does.

# Of the program; not those that are programs of their own.
commands() { limitcheck --help | sed -nE '/^Subcommands:/,/^$/s/^  ([a-z]+)  .*/\1/p' | grep -vE '^(reproduce|bench|shader)$'; }

HelpOfEveryCommandHasExamplesAndTheyRun() {
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' | tee cage.obj >scan.obj
  echo 0,1/3,1/3 >points.csv
  run 0 tessellate cage.obj --depth 2 -o fine.ply
  for k in 1 2; do
    run 0 audit naive tetrahedron octahedron --level quick --depth 1 --shard $k/2 --json part$k.json
  done
  local command line
  for command in $(commands); do
    run 0 "$command" --help
    sed -n '/^Examples:/,/^$/s/^  \(limitcheck .*\)/\1/p' out >lines
    holds "$(wc -l <lines)" -ge 2
    while read -r line; do
      [[ $line == "limitcheck $command" || $line == "limitcheck $command "* ]] || fail "$line is of another command"
      # A library of the user's; and what takes minutes, or all tests of the claims.
      case $line in *libmine* | 'limitcheck prove'* | 'limitcheck mutants'* | 'limitcheck claims' | 'limitcheck claims C14') continue ;; esac
      eval "$line" >out 2>err </dev/null
      holds $? -le 1
    done <lines
  done
}

# WIDTH: no line of the file out is wider but commands, which stay whole to be copied.
fits() {
  /usr/bin/python3 -c 'import re, sys
wide = [l for l in open("out", newline="\n").read().replace("\r", "").split("\n")
        if len(re.sub("\033[^m]*m", "", l)) > int(sys.argv[1]) and not l.lstrip(" ").startswith("limitcheck ")]
sys.exit("\n".join(wide) or 0)' "$1" || fail "wider than $1"
}

HelpAndAllElseFitsScreensOfEightyToTwoHundredColumns() {
  run 0 generate octahedron -o octahedron.obj
  {
    cat <<'E'
--help
help tags
generate --list
audit --explain all
check octahedron.obj
audit naive octahedron --depth 1
audit naive octahedron --depth 1 --details
audit all octahedron bumpy:20 --depth 2
audit all octahedron bumpy:20 --depth 2 --details
E
    commands | sed 's/$/ --help/'
  } >asked
  local arguments width
  while read -r arguments; do
    for width in 80 120 200; do
      [[ $arguments != 'audit all'* || $width != 120 ]] || continue
      # shellcheck disable=SC2086
      COLUMNS=$width "$PROGRAM" $arguments >out 2>err </dev/null
      fits $width
    done
  done <asked
}

HelpOfAuditPutsEveryOptionUnderATitle() {
  run 0 audit --help
  local title='' line
  while IFS= read -r line; do
    [[ $line != [!\ ]*: ]] || title=$line
    [[ $line != '  -'* ]] || [[ $line == '  -h,--help'* && $title == Options: || $line != '  -h,--help'* && $title != Options: ]] ||
      fail "$title $line"
  done <out
}

ColourIsAsItIsAskedFor() {
  local audit='audit naive octahedron --depth 1 --level quick'
  each 0 lacks $'\033' <<E
$audit
$audit --color never
E
  each 0 out $'\033[32mheld' <<<"$audit --color always"
  each 2 <<<"$audit --color sometimes"
  # A terminal's width is taken, and NO_COLOR respected unless colours are asked for.
  script -qec "stty cols 80; TERM=xterm NO_COLOR=1 '$PROGRAM' $audit 2>/dev/null" /dev/null >out 2>err </dev/null
  lacks $'\033'
  fits 80
}

# What looked at nothing says why.
NothingLookedAtHasThreeReasons() {
  run 0 audit cgal octahedron --depth 1 --level quick
  out '  not asked: determinism, ' '  not supported: ' # CGAL delivers no normals
  limitcheck audit all octahedron --depth 1 --level quick >out 2>err </dev/null
  out 'not asked' unsupported
}
