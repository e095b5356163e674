# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# `limitcheck hunt`, `prove`, `claims` and `tessellate`. That a fault is found is the business of
# verify/proof/maps/fault_test.cpp.
faulty='hunt faulty --option fault=adjacent_extraordinary,of=sliding-window --scheme loop --cases 32 --attempts 10 --in-process'

HuntShowsWhatItFoundBySmallMeshesAndCommands() {
  each 1 <<<"$faulty --json r.json --junit r.xml --witnesses w"
  out 'beside another extraordinary one'
  [[ $(<r.xml) == *'beside another extraordinary one'* ]] || fail 'JUnit does not say it'
  json r.json 'all(f["cases"] > 0 for f in r["findings"])'
  local small='next(f for f in r["findings"] if f["witness"] and f["check"] == "positions")'
  holds -e "$(value r.json "${small}['witness']")/control.obj"
  each 1 < <(value r.json "[${small}[k].removeprefix('limitcheck ') for k in ('command', 'found_on')]")
  holds -z "$(find . -name '*.part*')"
  each 0 <<<"$faulty --baseline r.json"
}

# Without what differs from run to run; the digest is of the seconds, too.
same_hunt() { json "$1" "{k: v for k, v in r.items() if k not in ('seconds', 'digest')} == {k: v for k, v in load('$2').items() if k not in ('seconds', 'digest')}"; }

HuntInPartsIsMergedToTheWhole() {
  each 1 <<E
$faulty --json whole.json --jobs 1
$faulty --json jobs.json --jobs 3
$faulty --jobs 2 --shard 1/2 --json part1.json
$faulty --jobs 2 --shard 2/2 --json part2.json
merge part2.json part1.json -o merged.json
E
  same_hunt jobs.json whole.json
  same_hunt merged.json whole.json
  refused 'merge -o wrong.json' <<'E'
part1.json
part1.json part1.json
part1.json whole.json
part1.json nothing.json
E
  holds ! -e wrong.json
}

HuntOfASubjectThatDiesHasAFinding() {
  printf 'read -r line\nkill -SEGV $$\n' >dies.sh
  run 1 hunt --program 'bash dies.sh' --cases 2 --attempts 4 --json r.json
  json r.json 'any(f["status"] == "crash" for f in r["findings"])'
}

HuntRefusesNonsense() {
  refused hunt <<'E'

nosuch
row-stream --cases 0
row-stream --time 0
row-stream --time 5q
row-stream --time -3s
row-stream --shard 3/2
row-stream --shard 1
row-stream --resume
row-stream --cases 3 --time 3s
all
openmesh --scheme loop --option a=b
row-stream --baseline nothing.json
row-stream --json x --junit x
E
}

ProvePrintsOneJsonDocumentWithARowForEveryTopologyAndKernel() {
  run 0 prove --depth 0 --valences 3,4 --kernel sliding-window --json
  # Where it takes more than ten seconds there are lines of progress, and nothing else.
  ! grep -vE '^limitcheck: [0-9]+/[0-9]+,.* s left: proof ' err || fail 'on standard error'
  json out 'r["held"]' 'r["impossible"] == ["3 3 4"]' 'all(x["map"] == "equal" and x["points"] > 0 for x in r["rows"])' \
    'all(x["digits"] >= 45 for x in r["rows"] if x["arithmetic"] == "digits" and x["digits"] is not None)' \
    'any("bound" in x for x in r["rows"])' 'all(x["worst"] <= x["bound"] for x in r["rows"] if "bound" in x)'
}

ProveKnowsCatmullClarksScheme() {
  run 0 prove --scheme catmull-clark --depth 0 --valences 3,5 --kernel sliding-window --json
  json out 'r["scheme"] == "catmull-clark"' 'r["held"]' 'all(x["map"] == "equal" for x in r["rows"])' \
    'all(x["worst"] <= x["bound"] for x in r["rows"] if "bound" in x)' \
    '{x["group"] for x in r["rows"]} >= set("quadruples deep high boundary cuts darts semi-sharp".split())'
}

ProveRefusesBadUsage() {
  refused prove <<'E'
--valences 2:4
--valences 6:3
--valences 6,x
--valences 21
--depth 9
--kernel naive
--set all
--scheme doo-sabin
E
}

ClaimsConfirmNothingWithoutTheirTestPrograms() {
  run 1 claims --json --programs . # as where only the program is installed
  err 'What follows is the register alone.'
  json out 'len(r["claims"]) == 92' 'not any(c["held"] or c["ran"] for c in r["claims"])' \
    'all(c["outcome"] == ("not run" if c["check"] else "not checkable") and c["message"] for c in r["claims"])' \
    'r["coverage"]["held"] == 0' 'r["verdicts"]["not checkable"] == 4' # what we conclude does not depend on what is installed
}

ClaimsHaveColumnsForWhatIsConcludedAndForTheTests() {
  run 1 claims C31 C80 --programs .
  out 'we conclude           our tests' 'refuted               not run ' 'not checkable         none' \
    '2 claims of the paper: refuted 1, not checkable 1' 'our tests: green 0, red 0, not run 1, none 1'
  run 2 claims C93
  err 'C01 to C92'
  run 0 claims --errata
  out '| C69 | Appendix A |'
}

ProgramsThatAnInstallationLacksAreSaidToBeElsewhere() {
  cp "$PROGRAM" alone
  for command in bench prove reproduce; do
    ./alone $command >out 2>err </dev/null
    holds $? = 2
    err "\`bash verify/run.sh $command\` makes it"
  done
}

TessellateWritesEveryTriangleItReports() {
  for file in out.ply out.obj; do
    run 0 tessellate bumpy:200 --strategy random --depth 4 --json -o $file
    silent # no progress unless standard error is a terminal
    cp out said
    json said 'r["fans"] > 0'
    run 0 check $file --json # a closed manifold of one piece: no T-vertices
    json out 'r["valid"]' 'r["boundary_edges"] == 0' 'r["components"] == 1' 'r["euler_characteristic"] == 2' \
      'r["faces"] == load("said")["triangles"]' 'r["vertices"] == load("said")["vertices"]'
  done
}

TessellateTellsOfSubstituteNormalsAndOnlyThen() {
  # A tetrahedron whose corners lie on one line.
  printf 'v 0 0 0\nv 1 1 1\nv 2 2 2\nv 3 3 3\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n' >needle.obj
  run 0 tessellate needle.obj --depth 2 -o needle.ply
  out 'substitute normals'
  run 0 tessellate tetrahedron --depth 2
  lacks substitute
}

TessellateCountsWhatTheDesignNamesAndTimesEachStage() {
  run 0 tessellate bumpy:800 --camera 0,0,4:0,0,0 --json
  json out 'all(isinstance(r[k], int) for k in "faces pairs singletons fans culled triangles vertices".split())' \
    'all(r["seconds"][k] >= 0 for k in "heuristics pairing evaluation write".split())' 'r["faces"] == 800' \
    '2 * r["pairs"] + r["singletons"] + r["culled"] == 800' 'r["culled"] > 200' 'r["output"] is None' \
    'r["strategy"] == "combined"' # a view is given
}

# 4^3 triangles per face; a closed surface of genus 0 has F / 2 + 2 vertices.
TessellateWithoutOptionsIsUniformOfDepthThree() {
  run 0 tessellate octahedron --json
  json out '(r["strategy"], r["triangles"], r["vertices"], r["culled"]) == ("uniform", 8 * 64, 8 * 32 + 2, 0)'
  run 0 tessellate octahedron
  out '8 faces: 4 pairs, 0 singletons, 0 fans, 0 culled; 512 triangles, 258 vertices'
}

TessellateWritesTheSameBytesWithAnyNumberOfThreadsAndOtherOnesWithAnotherSeed() {
  for k in 1 2 8; do
    run 0 tessellate bumpy:400 --strategy random --depth 4 --colour kind -o $k.ply --threads $k
    cmp 1.ply $k.ply || fail "with $k threads"
  done
  run 0 tessellate bumpy:400 --strategy random --depth 4 --colour kind -o seed.ply --seed 2
  ! cmp -s 1.ply seed.ply || fail 'two seeds, one file'
}

# FILE FILE: the same triangles, whose vertices are at most 5e-7 apart, and not the same.
near_files() {
  /usr/bin/python3 - "$@" <<'PYTHON' || fail "$1 and $2"
import sys
def read(name):
    lines = [line.split() for line in open(name)]
    return [[float(x) for x in w[1:]] for w in lines if w[0] == "v"], [w[1:] for w in lines if w[0] == "f"]
(a, f), (b, g) = map(read, sys.argv[1:])
worst = max(abs(x - y) for p, q in zip(a, b) for x, y in zip(p, q))
assert f == g and len(a) == len(b) and 0 < worst <= 5e-7, worst
PYTHON
}

# Both engines triangulate alike, so the files differ in rounding alone: at most 2e-7 of the sphere's size, and equal in all
# that counts.
TessellateStreamsRowsByDefaultAndKeepsThePapersFormOnRequest() {
  local what
  while read -r what; do
    each 0 <<<"tessellate $what --json -o rows.obj"
    cp out rows
    each 0 <<<"tessellate $what --json -o window.obj --engine sliding-window"
    json out 'r["engine"] == "sliding-window"' 'load("rows")["engine"] == "row-stream"' \
      'all(r[k] == load("rows")[k] for k in "pairs singletons fans stitched triangles vertices limit_points".split())'
    near_files rows.obj window.obj
  done <<'E'
bumpy:200 --depth 3
bumpy:200 --strategy random --depth 4
bumpy:200 --strategy random --depth 4 --repair stitch
E
  run 0 tessellate octahedron --depth 10 --json
}

# Which fuses no product with a sum, unlike the processor's kernels.
TessellateComputesOnAGraphicsCardOrSaysWhyNot() {
  run 2 tessellate octahedron --depth 9 --gpu
  for what in 'bumpy:200 --strategy random --depth 4' 'dual:bumpy:60 --depth 3'; do
    # shellcheck disable=SC2086
    if ! limitcheck tessellate $what --gpu --json -o there.obj >out 2>err; then
      err '--gpu: no OpenGL'
      return
    fi
    json out '"OpenGL" in r["device"]'
    each 0 <<<"tessellate $what --json -o here.obj"
    json out 'r["device"] is None'
    near_files here.obj there.obj
  done
}

# KEY ARGUMENTS..: of a tessellation of a sphere.
count() { limitcheck tessellate bumpy:200 --json "${@:2}" >out && value out "r['$1']"; }
TessellateObeysCullingCentreRepairAngleAndPixels() {
  holds "$(count culled --strategy combined --no-cull)" = 0
  holds "$(count culled --strategy random --cull)" -gt 0
  holds "$(count triangles --pixels 20)" -gt "$(count triangles --pixels 60)"
  holds "$(count triangles --strategy curvature --angle 10)" -gt "$(count triangles --strategy curvature --angle 40)"
  holds "$(count triangles --strategy curvature --angle 40,10)" -gt "$(count triangles --strategy curvature --angle 40)"
  holds "$(count stitched --strategy random --depth 4 --repair stitch)" -gt 0
  holds "$(count triangles --strategy combined --max-depth 1)" -le 800
  run 0 tessellate bumpy:200 --strategy random -o limit.ply
  run 0 tessellate bumpy:200 --strategy random -o flat.ply --centre flat
  holds "$(wc -c <limit.ply)" = "$(wc -c <flat.ply)"
  ! cmp -s limit.ply flat.ply || fail 'centres of fans are the same'
}

TessellateFromInsideShowsNothingAndSaysWhy() {
  run 0 tessellate octahedron --camera 0.01,0,0:1,0,0 -o nothing.ply --json
  json out 'r["triangles"] == 0'
  err 'is the camera inside?'
  holds -e nothing.ply
}

TessellateRefusesBadArgumentsAndWritesNothing() {
  touch empty.obj
  refused 'tessellate -o out.ply' <<'E'

no-such-mesh
empty.obj
octahedron --depth 40
octahedron --depth -1
octahedron --pixels 0
octahedron --pixels nan
octahedron --angle 0
octahedron --angle 1,2,3,4
octahedron --strategy best
octahedron --engine fast
octahedron --camera 1,2
octahedron --camera 1,2,3:1,2,3
octahedron --camera 1,2,x:0,0,0
octahedron --camera 0,0,4:0,0,0:0,0,1
octahedron --camera 0,0,4:0,0,0:0,1,0:1
octahedron --viewport 0x768
octahedron --viewport 640
octahedron --fov 180
octahedron --threads -1
octahedron --colour red
octahedron --centre middle
octahedron --strategy uniform --depth 4 --max-depth 3
octahedron --nonsense
E
  refused 'tessellate octahedron' <<'E'
-o out.stl
-o absent/out.ply
E
  holds "$(ls)" = $'empty.obj\nerr\nout\nscript.sh'
}
