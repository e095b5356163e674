# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# What happens around the program goes wrong: no memory, a full disk, closed streams, odd files. Each has its exit code and one
# line that says so, and nothing that was done is lost. (Signals: signals_test.cpp.)
quick='audit naive tetrahedron --depth 1 --level quick'

# Lines of a subject in bash: it says what it can do, and has read what it is then asked for.
tells_what_it_can() {
  cat <<'E'
read -r line
echo '{"limitcheck": 1, "status": "ok", "precision": "float64", "weights": "loop", "boundary": "spline", "points": "limit", "max_depth": 6, "normals": true, "per_face_depth": false, "exact_lattice": true}'
read -r line || exit 0
E
}
# CODE SCRIPT..: these lines of bash end with the code; what they say is in out and err.
script() {
  local code=0
  # shellcheck disable=SC2034
  told="$2"
  bash -c "$2" >out 2>err </dev/null || code=$?
  [[ $code == "$1" ]] || fail "exit code $code, not $1"
}

FullDiskBehindStandardOutputIsAnError() {
  local arguments
  while read -r arguments; do
    script 2 "limitcheck $arguments >/dev/full"
    [[ $(<err) == 'limitcheck: '* && $(wc -l <err) == 1 ]] || fail "$(<err)"
  done <<E
generate --list
$quick --json
$quick
eval icosahedron 0 1/3 1/3
tessellate icosahedron
claims --errata
--help
--version
E
}

# Beyond the range of the numbers no subject can be right: such meshes are refused before any is called.
MeshOfAbsurdSizeIsRefusedOrNotJudged() {
  for e in e200 e-200 e35; do
    # shellcheck disable=SC2059
    printf "v 1$e 1$e 1$e\nv -1$e -1$e 1$e\nv -1$e 1$e -1$e\nv 1$e -1$e -1$e\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n" >$e.obj
  done
  for e in e200 e-200; do
    each 2 err "limitcheck: $e.obj: the largest coordinate is 1${e:0:1}" <<E
audit row-stream $e.obj
audit naive $e.obj
tessellate $e.obj
audit --control $e.obj --tessellation $e.obj
E
    run 0 eval $e.obj 0 1/3 1/3 # the exact evaluator has no such limit
  done
  run 2 audit row-stream e35.obj --depth 1
  out 'not supported: e35.obj: the largest coordinate is 1e+35: with single precision'
  limitcheck audit opensubdiv-far:precision=double e35.obj --depth 1 --level quick >out
  lacks 'not supported: '
}

ClosedStreamsDoNotLandInTheFiles() {
  script 2 "limitcheck $quick --json report.json >&-"
  json report.json rows
  script 2 'limitcheck eval no-such.obj 0 0 0 2>&-'
  script 0 'limitcheck eval icosahedron 0 0 0 <&-'
}

# In a pipe as in a script that ignores the signal.
ReaderThatGoesAwayEndsTheProgramInSilenceAndCostsNoReport() {
  limitcheck audit naive tetrahedron --depth 1 --level quick --json report.json --junit report.xml | true
  json report.json rows
  [[ $(<report.xml) == *'</testsuites>'* ]] || fail 'the JUnit file is cut'
  local arguments before code
  while read -r arguments; do
    for before in '' "trap '' PIPE;"; do
      bash -c "$before limitcheck $arguments | true; exit \${PIPESTATUS[0]}" >out 2>err
      code=$?
      [[ $code == 141 || $code == 0 ]] || fail "$before $arguments: $code" # 0: it was quicker than the reader
      silent
    done
  done <<E
$quick
generate --list
eval cube 0 0 0 --digits 9000
E
  script 141 "trap '' PIPE; { sleep 0.5; limitcheck eval cube 0 0 0; } | true; exit \${PIPESTATUS[0]}"
  silent
}

# Latin-1, an escape sequence, U+FFFE.
ForeignTextIsMadeVisibleAtEveryOutput() {
  local name=$'caf\xe9 \x1b[31m\xef\xbf\xbe.obj' arguments file
  run 0 generate cube -o cube.obj
  cp cube.obj "$name"
  while read -r arguments; do
    # shellcheck disable=SC2086
    limitcheck $arguments "$name" >out 2>err </dev/null
    [[ -s out || -s err ]] || fail "$arguments"
    [[ $arguments != *' --json' ]] || json out r
    for file in out err j.xml r.json p.html; do
      [[ -e $file ]] || continue
      ! grep -q $'\033' $file || fail "$file of $arguments has an escape sequence"
      iconv -f UTF-8 -t UTF-8 $file >utf8 || fail "$file of $arguments is no UTF-8"
    done
  done <<'E'
check
check --json
audit naive --details --depth 1
audit opensubdiv-bfr --depth 1 --junit j.xml --json r.json --html p.html
tessellate --json
audit --depth
generate
eval --subject naive 0 0 0
E
  /usr/bin/python3 -c 'import xml.dom.minidom as x; x.parse("j.xml")' || fail 'j.xml is no XML'
  json r.json rows
  holds -s p.html
}

NumbersBeyondTheirRangeAreRefusedAndNotCut() {
  sed 's/N$/18446744073709551616/' >beyond <<'E' # 2^64
hunt naive --seed N
hunt naive --cases N
hunt naive --attempts N
tessellate cube --seed N
tessellate cube --depth N
tessellate cube --threads N
audit naive cube --memory N
audit naive cube --depths random:N
audit naive cube --sample N
audit naive cube --sample 3:N
generate bumpy:20 -o x.obj --seed N
eval cube 0 0 0 --digits N
prove --depth N
hunt naive --shard 1/N
E
  refused '' <beyond
  run 0 tessellate cube --seed 18446744073709551615
}

ReportThroughAPipeOrALinkLeavesThePipeAndTheLink() {
  mkfifo pipe
  cat pipe >got &
  run 0 audit naive tetrahedron --depth 1 --level quick --junit pipe
  wait
  holds -p pipe
  [[ $(<got) == *'</testsuites>'* ]] || fail 'nothing came through the pipe'
  local arguments
  while read -r arguments; do
    rm -f link.*
    touch real
    ln -s real link.obj
    ln -s real link.obj.json
    each 0 <<<"$arguments"
    holds -L link.obj -a -L link.obj.json -a -s real
    rm real
  done <<E
$quick --json link.obj.json
generate icosahedron -o link.obj
tessellate icosahedron -o link.obj
E
}

# Nor does a file that may not grow.
ReportWhereADirectoryIsLeavesNothingBehind() {
  mkdir report.json
  each 2 <<<"$quick --json report.json"
  out positions # the table is there all the same
  holds "$(ls)" = $'err\nout\nreport.json\nscript.sh'
  rmdir report.json
  script 2 "ulimit -f 1; limitcheck $quick --json report.json >/dev/null"
  err FILE_CANNOT_WRITE
  holds "$(ls)" = $'err\nout\nscript.sh'
}

# The control mesh is smaller than what a file may hold here, the rest of the witness is not.
WitnessIsAWholeFolderOrNone() {
  script 2 'ulimit -f 1; limitcheck audit opensubdiv-far:precision=double fan:5 --depth 1 --level quick --witnesses w >/dev/null'
  holds -z "$(ls -A w)"
}

NoMemoryIsOneLineAndExitCodeTwo() {
  run 2 audit naive bumpy:4000 --depth 12 # and not hours of swapping
  nothing
  err 'bumpy:4000: the audit of 3.36e+10 points needs some 11753 GB'
  [[ -z $SANITIZED ]] || return # a sanitizer needs more addresses than it is left here
  script 2 'ulimit -v 200000; limitcheck tessellate bumpy:4000 --depth 7 -o out.ply'
  holds "$(<err)" = 'limitcheck: out of memory'
  holds "$(ls)" = $'err\nout\nscript.sh'
}

FilesThatAreNoneAreRefused() {
  mkdir folder.obj
  touch empty.obj
  for file in '' / . /dev/zero folder.obj empty.obj /dev/null; do
    run 2 eval "$file" 0 0 0
    [[ $(<err) == 'limitcheck: '* ]] || fail "$file"
  done
  truncate -s 5G large.obj
  run 2 eval large.obj 0 0 0
  err FILE_TOO_LARGE
  rm large.obj
}

OptionsThatNameNoFileOrNoNumberAreRefusedAtOnce() {
  echo '{"waivers": [{"subject": "*", "check": "*", "reason": "r", "expires": "9999-99-99"}]}' >9999.json
  echo '{"waivers": [{"subject": "*", "check": "*", "reason": "r", "reason": "s", "expires": "2099-01-01"}]}' >twice.json
  mkdir folder
  touch r.json
  ln -s r.json link.json
  ulimit -t 20
  local options words
  while IFS='|' read -r options words; do
    each 2 err "$words" <<<"$quick $options"
    holds ! -s r.json
  done <<'E'
--depths file:/dev/zero|FILE_CANNOT_OPEN
--waivers /dev/zero|FILE_CANNOT_OPEN
--waivers 9999.json|is no date
--waivers twice.json|"reason" stands twice
--timeout nan|no finite number
--timeout inf|--timeout
--shrink nan|no finite number
--json r.json --junit r.json|--json and --junit name the same file
--json r.json --junit ./folder/../r.json|name the same file
--json r.json --junit link.json|name the same file
E
  run 0 generate octahedron -o o.obj
  each 2 <<'E'
audit --control o.obj --tessellation o.obj --tolerance nan
audit --control o.obj --tessellation o.obj --max-deviation nan
audit --control o.obj --tessellation o.obj --provenance /dev/zero
audit --control o.obj --tessellation o.obj --json x.json --per-vertex x.json
E
}

LackOfMemoryOfTheHostIsNotBlamedOnTheSubject() {
  [[ -z $SANITIZED ]] || return
  {
    tells_what_it_can
    printf '%s\n' 'head -c 144 > /dev/null' "echo '{\"status\": \"ok\"}'" 'read -r line' \
      "echo '{\"status\": \"ok\", \"vertices\": 40000000, \"triangles\": 4}'" 'sleep 1'
  } >many.sh
  script 2 'ulimit -v 1500000; limitcheck audit --program "bash many.sh" tetrahedron --depth 0 --level quick --json -'
  json out 'r["incomplete"] == "this program ran out of memory"' 'all(x["status"] == "not-run" for x in rows)'
}

# Whatever this system does not give a right subject in a process of its own: no row is a breakdown of it.
LackOfTheSystemIsNotJudgedAndNoFaultOfTheSubject() {
  [[ -z $SANITIZED ]] || return
  local code
  for limit in '-n 16' '-n 20' '-v 600000' '-v 250000' '-v 100000' '-d 60000' '-u 3'; do
    rm -f r.json r.jsonl
    bash -c "ulimit $limit; limitcheck audit naive tetrahedron --isolate --depth 1 --level quick --json r.json" >out 2>err </dev/null
    code=$?
    [[ $code == 2 || $code == 0 ]] || fail "exit code $code under $limit" # root may start as many processes as it likes
    lacks FINDING high
    [[ $(<err) != *high* ]] || fail 'a finding'
    [[ $code == 0 || ! -e r.json ]] ||
      json r.json 'r["incomplete"] is not None' 'all((x["status"], x["origin"]) == ("not-run", "host") for x in rows)'
  done
}

# A subject that crashes where it may have met a limit of the system, and one that crashes where it has enough.
BreakdownUnderTightLimitsIsNotJudged() {
  [[ -z $SANITIZED ]] || return
  { tells_what_it_can; echo 'kill -SEGV $$'; } >dies.sh
  local limit code row words
  while IFS='|' read -r limit code row words; do
    script "$code" "prlimit $limit '$PROGRAM' audit --program 'bash dies.sh' tetrahedron --depth 1 --level quick --json -"
    json out "(rows[0]['origin'], rows[0]['status']) == ($row)" 'not r["held"]' "'$words' in rows[0]['message']"
  done <<'E'
--nofile=63|2|'host', 'not-run'|the system allows 63 open files
--nproc=63|2|'host', 'not-run'|the system allows 63 processes
--as=3000000000|2|'host', 'not-run'|the system allows 3000000000 bytes of addresses
--data=3000000000|2|'host', 'not-run'|the system allows 3000000000 bytes of data
--nofile=64|1|'subject', 'crash'|
E
}

FullDiskLeavesWhatWasThereAndNoHalfFile() {
  [[ -z $SANITIZED ]] || return
  unshare -Urm true || return 0
  run 0 generate bumpy:2000 -o m.obj
  local arguments
  while read -r arguments; do
    script 2 "unshare -Urm bash -c 'mkdir -p disk; mount -t tmpfs -o size=1m none disk || exit 77
      for e in obj ply glb json; do echo old >disk/out.\$e; done; cat /dev/zero >disk/fill 2>log
      \"\$0\" $arguments >log; code=\$?; ls -A disk; cat disk/out.*; exit \$code' '$PROGRAM'"
    err FILE_CANNOT_WRITE
    holds "$(<out)" = $'fill\nout.glb\nout.json\nout.obj\nout.ply\nold\nold\nold\nold'
  done <<'E'
generate bumpy:2000 -o disk/out.obj
generate bumpy:2000 -o disk/out.ply
repair m.obj -o disk/out.obj
tessellate bumpy:800 -o disk/out.glb
audit naive cube --depth 1 --level quick --json disk/out.json
audit naive cube --depth 1 --level quick --junit disk/out.json
audit naive cube --depth 1 --level quick --html disk/out.json
audit naive cube --depth 1 --level quick --shard 1/2 --json disk/out.json
prove --depth 0 --valences 3 --json disk/out.json
E
}

SystemWithoutNamespacesHoldsProcessesByASubreaper() {
  [[ -z $SANITIZED ]] || return
  unshare -Ur bash -c 'echo 0 >/proc/sys/user/max_pid_namespaces' || return 0
  script 0 "unshare -Ur bash -c 'echo 0 >/proc/sys/user/max_pid_namespaces
    \"\$0\" audit naive tetrahedron --isolate --depth 1 --level quick --json r.json' '$PROGRAM'"
  json r.json '"subreaper" in r["containment"]'
}

RowsSayWhoseDoingABreakdownIs() {
  { tells_what_it_can; echo 'kill -SEGV $$'; } >subject.sh
  { tells_what_it_can; echo 'sleep 1000'; } >limit.sh
  for origin in subject limit; do
    run 1 audit --program "bash $origin.sh" tetrahedron --depth 1 --level quick --timeout 1 --json
    json out "rows[0]['origin'] == '$origin'" 'rows[1]["origin"] is None'
  done
}

ExistingFileKeepsItsMode() {
  run 0 generate cube -o broken.obj
  touch out.obj
  chmod 640 out.obj
  for command in 'generate cube' 'repair broken.obj' 'tessellate cube'; do
    each 0 <<<"$command -o out.obj"
    holds "$(stat -c %a out.obj)" = 640
  done
}

# Twenty moments; verify/kills.sh has more.
KilledAtAnyMomentItEndsInTheSameReport() { script 0 "bash '$SOURCE/verify/kills.sh' '$PROGRAM' 4"; }

NamesMayHaveSpacesQuotesAndOtherAlphabets() {
  mkdir 'Größe "ñ" 网格'
  cd 'Größe "ñ" 网格' || return
  run 0 generate icosahedron -o "a b'ü.obj"
  run 1 audit opensubdiv-bfr "a b'ü.obj" --depth 1 --json 'r é.json'
  local line
  sed -n 's/^ *limitcheck eval/eval/p' out >again
  holds -s again
  while read -r line; do each 1 <<<"$line"; done <again
}

# A variable of a script that is not set: nothing is audited, evaluated or written in the place of what it should have named.
EmptyNamesAreRefused() {
  refused '' <<'E'
audit --shader '' octahedron
audit --program '' octahedron
audit '' octahedron
audit naive '' --depth 0
hunt '' --cases 1
eval octahedron 0 0 0 --subject ''
tessellate octahedron --seed ''
tessellate octahedron --seed -1
tessellate octahedron --strategy view --camera ''
tessellate octahedron -o ''
E
}
