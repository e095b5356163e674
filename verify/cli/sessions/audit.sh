# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# `limitcheck audit`: exit codes, what goes where, and the commands that are printed.

AuditEndsWithZeroWhenAllHeld() {
  run 0 audit opensubdiv-far tetrahedron --depth 2 --level quick --option precision=double --json made/report.json
  out opensubdiv-far:precision=double positions
  silent          # no progress unless standard error is a terminal
  lacks $'\033'   # no colour unless standard output is a terminal
  json made/report.json 'r["held"]'
}

AuditEndsWithOneOnFindings() {
  run 1 audit opensubdiv-bfr bumpy:20 --depth 2
  out FINDING
  run 1 audit opensubdiv-bfr bumpy:20 --depth 2 --json -
  json out 'r["depth"] == 2' \
    'rows and all(k in x for x in rows for k in "subject mesh check status count worst bound unit witness".split())'
}

# Whoever names a mesh wants it judged.
AuditEndsWithTwoWhereNothingWasJudgedOnAMeshThatWasNamed() {
  run 2 audit openmesh octahedron dart:6 --depth 1 --level quick
  err 'nothing was judged on dart:6: openmesh: does not do edges that stay sharp'
  run 0 audit naive octahedron dart:6 --depth 1 --level quick
}

AuditEndsWithTwoOnBadUsageAndBadInput() {
  refused audit <<'E'
no-such-subject
naive no-such-mesh
naive tetrahedron --depth 99
naive tetrahedron --no-such-option
naive --option nonsense=1 tetrahedron
all tetrahedron --option precision=double
naive tetrahedron --depths sideways
naive tetrahedron --depths random:x
naive tetrahedron --json report.txt
naive tetrahedron --checks ''
naive tetrahedron --checks positions,,normals
naive tetrahedron --checks -
naive tetrahedron --checks file-positions
naive tetrahedron --checks positions --must-refuse
naive tetrahedron --checks normals --require-coverage
naive tetrahedron --shard 1/2
naive tetrahedron --shard 1/2 --json
naive tetrahedron --shard 3/2 --json x.json
naive tetrahedron --shard x --json x.json
row-stream octahedron --exhaustive 3
row-stream --depth 1 --exhaustive 3
all --exhaustive 3
naive tetrahedron --html same --junit same
E
  run 2 audit naive tetrahedron --checks position
  err "'position'" 'positions, '
}

AuditOfOneSubjectSaysWhichMeshesOfThePlanItLeavesOut() {
  run 0 audit row-stream --level quick
  out " of the plan's meshes: row-stream: does not do semi-sharp edges and vertices"$'\n'
}

AuditOfAllSubjectsGoesOnWhenOneRefuses() {
  run 1 audit all wheel:50:1 --depth 1 --json - # OpenMesh ends at valence 49
  json out 'row("tessellates", subject="openmesh")["status"] == "finding"' \
    'row("coverage", subject="cgal")["status"] == "held"'
}

AuditOfOurEngineHoldsAtRandomAndAtViewDependentDepths() {
  for depths in random random:7 view; do
    run 0 audit sliding-window bumpy:200 icosahedron holes wheel:50 --level quick --depths $depths --json report.json
    json report.json "r['depths'] == '${depths%:*}'" 'all(x["status"] == "held" for x in rows)'
    case $depths in
      view) out 'depth 4 at most, view on 4 meshes'; json report.json 'r["seed"] is None' ;;
      random) out 'depth 4 at most, random (seed 1)'; json report.json 'r["seed"] == 1' ;;
      *) out 'depth 4 at most, random (seed 7)'; json report.json 'r["seed"] == 7' ;;
    esac
  done
}

# Hunts found these: from an origin common to the mesh, normals of faces that are small beside it were off.
AuditOfRowStreamingHoldsOnFacesFarFromTheOrigin() {
  each 0 <<'E'
audit row-stream stretched:3:random:721344855:149 --depth 3 --level quick --depths random:219857:visible
audit row-stream turned:222828:mixed-creased:110777438:172 --depth 4 --scheme catmull-clark --level thorough --depths random:502895:visible
E
}

# Beyond Embree's arrays an assertion of the library would end the audit.
AuditOfEmbreeDoesNotHandItRingsBeyondItsArrays() {
  run 1 audit embree quad-fan:63 quad-wheel:64 --depth 0 --level quick --details
  lacks 'Embree has no rings'
  out 'not supported or not run' # came to its end
  run 1 audit embree quad-fan:64 quad-wheel:65 --depth 0 --level quick --details
  out 'Embree has no rings of more than 64 faces' 'not supported or not run'
}

AuditWithoutMeshesAndDepthsFollowsThePlanAndWithDepthsAsksJustThose() {
  local depths='{x["depths"] if x["depths"] != "uniform" else x["depth"] for x in rows}'
  run 1 audit null --level quick --json -
  json out "$depths >= {0, 1, 4, 7, 'random:1', 'view', 'face0-culled', 'all-culled'}"
  run 1 audit null --level quick --json - --depth 1
  json out "$depths == {1}"
  run 1 audit null --level quick --json - octahedron
  json out "$depths == {4}"
  run 1 audit null --level quick --json - octahedron --depth 2 --depths random:5:visible
  json out "$depths == {'random:5:visible'}"
}

AuditSaysWhatItLookedAtAndEndsWithTwoIfAllIsRequired() {
  run 2 audit row-stream icosahedron --require-coverage --json
  json out '"never looked at" in r["incomplete"]' 'len(r["coverage"][0]["never"]) == 100' \
    'r["coverage"][0]["looked_at"] < r["coverage"][0]["declared"]'
  run 0 audit row-stream --level quick --require-coverage
  out ' kinds of neighbourhood were looked at'
  lacks '; never: '
}

AuditEndsWithTwoIfWhatIsRequiredWasNotJudged() {
  run 0 audit cgal octahedron --depth 1 --level quick
  out 'normals of cgal were never judged'
  run 0 audit cgal octahedron --depth 1 --level quick --require refined-positions,coverage
  run 2 audit cgal octahedron --depth 1 --level quick --require coverage,positions,normals --json report.json
  out 'INCOMPLETE: positions of cgal were never judged'
  json report.json 'not r["held"]' 'r["never_judged"][0]["check"] == "normals"'
  run 2 audit cgal octahedron --depth 1 --level quick --require no-such-check
}

AuditWithoutRepairFindsCracksAtRandomAndAtViewDependentDepths() {
  for depths in random view; do
    run 1 audit sliding-window bumpy:200 --option repair=none --json - --depths $depths
    json out 'all(row(c)["status"] == "finding" for c in ("watertight", "t-vertices"))'
  done
}

AuditOfASubjectWithoutADepthPerFaceIsNotSupportedAndNoFinding() {
  run 2 audit cgal icosahedron --depths random --json -
  json out 'not r["held"]' '"nothing was looked at" in r["incomplete"]' 'rows[0]["check"] == "tessellates"' \
    'rows[0]["status"] == "not-supported"' '"one depth for the whole mesh" in rows[0]["message"]'
}

AuditPrintsACommandWithAFindingThatRecomputesTheExpectedValue() {
  for precision in float double; do
    run 1 audit opensubdiv-bfr bumpy:20 --depth 3 --option precision=$precision --details --json report.json
    local command
    command=$(value report.json '"eval bumpy:20 {face} {l1} {l2}".format(**row("positions")["witness"])')
    [[ $precision == double ]] || command+=' --precision float'
    out "limitcheck $command"$'\n'
    each 0 <<<"$command --json"
    json out 'near(r["position"], next(x for x in load("report.json")["results"] if x["check"] == "positions")["witness"]["expected"])'
  done
}

AuditOfNamedChecksLooksAtTheseAloneOrAtAllButThose() {
  local checks='{x["check"] for x in rows}'
  run 0 audit naive tetrahedron --depth 1 --json all.json
  local all='{x["check"] for x in load("all.json")["results"]}'
  run 0 audit naive tetrahedron --depth 1 --checks positions,normals --json -
  json out "$checks == {'normals', 'positions', 'tessellates'}"
  run 0 audit naive tetrahedron --depth 1 --checks -determinism,-extreme-scale --json -
  json out "$checks == $all - {'determinism', 'scaling'}" 'r["left_out"] == ["determinism", "scaling"]'
  run 0 audit naive tetrahedron --depth 1 --checks -tessellates --json -
  json out "$checks == $all"
  # Rows that are made of others' evidence, and the row of subjects that deliver refined points.
  run 0 audit naive octahedron --depth 1 --checks state --json -
  json out "$checks == {'state', 'tessellates'}"
  run 0 audit openmesh tetrahedron --depth 1 --checks positions --json -
  json out "'refined-positions' in $checks"
}

AuditJudgesNothingThatIsLeftOut() {
  local bad='faulty:fault=wrong_limit_mask,of=model'
  run 1 audit $bad tetrahedron --depth 1 --level quick --json old.json
  run 2 audit $bad tetrahedron --depth 1 --level quick --checks normals --baseline old.json --require positions --json r.json
  out "positions of $bad were never judged: left out"
  json r.json 'r["changes"]["gone"] == 0'
}

AuditOfChosenChecksIsJoinedFromParts() {
  for k in 1 2; do
    run 0 audit naive tetrahedron octahedron --depth 1 --checks positions,mirror --shard $k/2 --json part$k.json
  done
  run 0 merge part1.json part2.json -o whole.json
  out 'only these checks'
  json whole.json '{x["check"] for x in rows} == {"mirror", "positions", "tessellates"}'
}

AuditLooksAgainAtWhatHadFindingsAndAtNothingElse() {
  # Of these meshes and depths fan:1 has findings in relations, too.
  run 1 audit all fan:1 bumpy:20 --depth 2 --threads 2 --json r.json
  local findings
  findings=$(value r.json 'sum(x["status"] == "finding" for x in rows)')
  holds "$findings" -gt 5
  run 1 audit --rerun r.json --json again.json
  out "of $findings findings in r.json: 0 gone, $findings still there"$'\n'
  json again.json 'len(rows) < len(load("r.json")["results"]) / 2' \
    'all(x["check"] in ("tessellates", "recognised") or (x["subject"], x["mesh"], x["check"]) in {(y["subject"], y["mesh"], y["check"]) for y in load("r.json")["results"] if y["status"] == "finding"} for x in rows)'
}

AuditSaysOfWhatIsMendedThatItIsGone() {
  run 0 audit naive tetrahedron octahedron --depth 2 --sample 4:7 --json r.json
  run 0 audit --rerun r.json
  out 'no findings'
  /usr/bin/python3 -c 'import json
report = json.load(open("r.json"))
planted = [x for x in report["results"] if x["mesh"] == "octahedron" and x["check"] in ("positions", "rotation")]
assert len(planted) == 2
for x in planted: x.update(status="finding", count=1)
json.dump(report, open("old.json", "w"))' || fail planting
  run 0 audit --rerun old.json --json r.json
  out $'of 2 findings in old.json: 2 gone, 0 still there\n'
  json r.json 'all((x["mesh"], x["sample"]) == ("octahedron", "4:7") for x in rows)'
  refused 'audit --rerun old.json' <<'E'
naive
--depth 3
--checks positions
--baseline old.json
--shard 1/2
--level quick
--require-coverage
E
  refused audit <<'E'
--rerun none.json
--rerun script.sh
E
}

# Each status an audit can give really comes out of the program, the same in JSON, JUnit and table.
#   STATUS CELL ELEMENT CHECK CODE ARGUMENTS: the last are those of the audit, as a shell has them
status() {
  eval "run $5 audit --details $6 --json report.json --junit junit.xml"
  json report.json "r['held'] == ($5 == 0)" "[x['status'] for x in rows if x['check'] == '$4'][-1] == '$1'"
  holds "$(python3 -c 'import sys, xml.etree.ElementTree as tree
cases = [c for c in tree.parse("junit.xml").getroot().iter("testcase") if c.get("name") == sys.argv[1]]
print("".join(child.tag for child in cases[0]), end="")' "$4")" = "$3"
  [[ $(grep -m 1 "^  $4 " out) == *"$2"* ]] || fail "the table does not say $2 of $4"
}
AuditStatusIsTheSameInJsonJUnitAndTable() {
  cat >waivers.json <<'E'
{"waivers":[{"subject":"opensubdiv-far*","check":"normals","shape":"fan:5","reason":"boundary tangents","expires":"2999-12-31"},
  {"subject":"row-stream","check":"positions","shape":"*","reason":"was off","expires":"2999-12-31"}]}
E
  cat >fail.sh <<'E'
read q; echo '{"limitcheck":1, "status":"ok", "precision":"float64", "weights":"loop", "boundary":"spline", "points":"limit", "max_depth":9, "normals":true, "per_face_depth":true, "exact_lattice":true}'
read q; echo '{"status":"failed", "message":"no luck"}'
E
  status held held '' positions 0 'row-stream tetrahedron --depth 1 --level quick'
  status finding FINDING failure normals 1 'opensubdiv-bfr fan:5 --depth 1 --level quick'
  status quality-warning warning system-out face-order 0 'naive fan:5 --depth 1'
  status not-supported 'not supported' skipped positions 0 'cgal tetrahedron --depth 1 --level quick'
  status not-run 'not run' skipped positions 1 "--program 'exit 3' tetrahedron --depth 1"
  status crash CRASH error tessellates 1 "--program 'kill -SEGV \$\$' tetrahedron --depth 1"
  status timeout TIMEOUT error tessellates 1 "--program 'sleep 1000' tetrahedron --timeout 0.3"
  status error ERROR error tessellates 1 "--program 'sh fail.sh' tetrahedron"
  status waived waived skipped normals 1 'opensubdiv-far:precision=double fan:5 --depth 1 --level quick --waivers waivers.json'
  status unexpected-pass 'STALE WAIVER' system-out positions 0 'row-stream tetrahedron --depth 1 --level quick --waivers waivers.json'
}

AuditConfirmsNothingWhereEverySubjectBreaksDown() {
  for limit in '--timeout 0.001' '--memory 1'; do
    each 1 <<<"audit all tetrahedron --isolate --json - $limit"
    json out 'all(x["status"] != "held" for x in rows)' \
      "any(x['status'] == '$([[ $limit == *memory* ]] && echo crash || echo timeout)' for x in rows)"
  done
}
