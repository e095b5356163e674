# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# What `limitcheck audit` writes besides the table: JSON by its schema, JUnit, the page, waivers, baselines, witnesses.

ReportIsValidByThePublishedSchema() {
  # Everything held; findings with witnesses; NaN; a subject that refuses.
  local arguments
  while read -r arguments; do
    eval "limitcheck audit $arguments --json report.json" >out 2>err </dev/null
    holds $? -le 1
    /usr/bin/python3 -c 'import json, jsonschema, sys
schema = json.load(open(sys.argv[1]))
jsonschema.Draft7Validator.check_schema(schema)
jsonschema.validate(json.load(open("report.json")), schema)' "$SOURCE/verify/report/schema/audit.schema.json" || fail "$arguments"
  done <<'E'
naive tetrahedron fan:1 --depth 2
opensubdiv-bfr fan:1 bumpy:20 --depth 2
null tetrahedron --depth 1
openmesh wheel:50:1 --depth 1 --depths uniform
faulty:fault=nan_position,of=model tetrahedron --depth 1 --level quick
--program 'kill -SEGV $$' tetrahedron
--program 'sleep 1000' tetrahedron --timeout 0.3
E
}

ReportOfAFindingHasFortyDigitsAndTheCommandThatRepeatsIt() {
  run 1 audit opensubdiv-bfr bumpy:20 --depth 3 --level quick --json report.json
  json report.json 'len(row("positions")["witness"]["expected_digits"]) == 3' \
    'near(row("positions")["witness"]["expected_digits"], row("positions")["witness"]["expected"])' \
    'all(x["witness"]["reproduce"] == "limitcheck audit opensubdiv-bfr bumpy:20 --depth 3 --level quick" for x in rows if x["status"] == "finding")'
  run 1 audit opensubdiv-bfr bumpy:20 --depth 3 --level quick
}

ReportInJUnitIsReadByAConsumer() {
  run 1 audit opensubdiv-bfr bumpy:20 --depth 2 --junit out.d/junit.xml
  /usr/bin/python3 -c 'import xml.etree.ElementTree as tree
root = tree.parse("out.d/junit.xml").getroot()
assert root.tag == "testsuites"
for suite in root:
  cases = suite.findall("testcase")
  assert int(suite.get("tests")) == len(cases) > 10
  assert int(suite.get("failures")) == len(suite.findall("testcase/failure")) > 0
  assert int(suite.get("skipped")) == len(suite.findall("testcase/skipped"))
  assert all(c.get("name") and c.get("classname") for c in cases)' || fail 'JUnit'
}

ReportWithAWaivedFindingHasNoneAndSaysWhichWaiverIsSuperfluous() {
  local bad='audit faulty:fault=wrong_limit_mask,of=model tetrahedron --depth 1 --level quick'
  each 1 <<<"$bad"
  cat >waivers.json <<'E'
{"waivers":[{"subject":"faulty:*","check":"*","shape":"tetrahedron","reason":"planted","expires":"2999-12-31"},
  {"subject":"other","check":"positions","reason":"gone","expires":"2999-12-31"},
  {"subject":"faulty:*","check":"positions","reason":"old","expires":"2001-01-01"}]}
E
  each 0 <<<"$bad --waivers waivers.json --json report.json"
  json report.json 'any(x["status"] == "waived" for x in rows)' 'sum(x["check"] == "waiver" for x in rows) == 2'
  echo '{"waivers":[{"subject":"faulty:*"}]}' >waivers.json
  each 2 <<<"$bad --waivers waivers.json"
  echo '{"waivers":[{"subject":"*","check":"tessellates","reason":"known","expires":"2999-12-31"}]}' >waivers.json
  run 0 audit --program "kill -SEGV \$\$" tetrahedron --waivers waivers.json # nothing is red
  out 'waived: '
}

# On a terminal there are colours and a line of progress that is written over, on one that is dumb there are none.
ReportHasNoEscapeSequencesOnADumbTerminal() {
  for term in xterm dumb; do
    TERM=$term script -qec "'$PROGRAM' audit naive octahedron --depth 1" /dev/null >out 2>err </dev/null
    if [[ $term == xterm ]]; then out $'\033['; else lacks $'\033['; fi
  done
}

ReportsExplainEveryCheck() {
  run 0 audit --explain positions
  out bound
  run 2 audit --explain nonsense
  run 0 audit --explain extreme-scale
  cp out extreme-scale
  run 0 audit --explain scaling # its new name
  cmp out extreme-scale || fail 'another text'
  run 0 audit --explain all
  out tessellates rejected-inputs t-vertices
}

ReportsOfHigherLevelsHaveMoreRows() {
  local last=0
  for level in quick standard thorough; do
    run 0 audit model bumpy:400 tetrahedron --depth 1 --json report.json --level $level
    json report.json "len(rows) > $last"
    last=$(value report.json 'len(rows)')
  done
}

ReportOfEachCauseHasACommandThatShowsTheDifference() {
  run 1 audit all fan:1 fan:5 prism:3 quad-fan:2 quad-dart:4 wheel:50 --depth 2 --json report.json
  holds "$(wc -l <out)" -le 50
  json report.json 'len(r["causes"]) >= 8' \
    'all((x["cause"] is not None) == (x["status"] in ("finding", "crash", "error")) for x in rows)'
  local command shown=0
  while read -r command; do
    each 1 <<<"${command#limitcheck }"
    [[ $command == 'limitcheck eval '* ]] || continue
    out '<-- wrong' expected
    ((++shown))
  done < <(value report.json '[c["command"] for c in r["causes"]]')
  holds $shown -ge 4
}

ReportAsAPageHasEverythingInside() {
  run 1 audit opensubdiv-bfr quad-fan:1 --depth 2 --html page.html
  cp page.html out
  out '"positions":"' '"of":"positions","bound":'                # the mesh, and the bound of the histogram
  lacks '%DATA%' '"control":""' '"bound":null' 'src="http'       # the control mesh's edges; opens without a network
  holds "$(wc -c <page.html)" -lt 2000000
  # Who runs no script reads overview and causes all the same.
  sed -n '/<noscript>/,/<\/noscript>/p' page.html >out
  out '<th>subject</th>' '<td>opensubdiv-bfr</td>' '<li>high, opensubdiv-bfr: ' '<code>limitcheck '
  lacks '%PLAIN%'
  # Its policy lets in its own style and script, by their digests, and nothing from elsewhere.
  /usr/bin/python3 -c 'import re, hashlib, base64
page = open("page.html").read()
policy = re.search("""http-equiv="Content-Security-Policy" content="(.*?)\"""", page).group(1)
digest = lambda tag: "\x27sha256-" + base64.b64encode(hashlib.sha256(re.search(
  "<" + tag + ">(.*?)</" + tag + ">", page, re.S).group(1).encode()).digest()).decode() + "\x27"
assert policy == "default-src \x27none\x27; style-src " + digest("style") + "; script-src " + digest("script"), policy
assert not re.search(" style=| on[a-z]+=", page)' || fail 'the policy'
}

ReportAgainstABaselineFindsOnlyWhatIsNewOrWorse() {
  run 1 audit opensubdiv-bfr bumpy:20 --depth 2 --level quick --json old.json
  run 0 audit opensubdiv-bfr bumpy:20 --depth 2 --level quick --baseline old.json
  out 'since old.json: 0 new, 0 worse, 0 gone'
  run 1 audit opensubdiv-bfr bumpy:20 fan:1 --depth 2 --level quick --baseline old.json # another mesh has new ones
  echo '{}' >none.json
  run 2 audit opensubdiv-bfr bumpy:20 --depth 2 --level quick --baseline none.json
}

ReportAndNotTheScreenHasWhatASubjectPrints() {
  run 1 audit openmesh tetrahedron --depth 1 --json report.json
  [[ $(<err) != *add_face* ]] || fail 'it is on the screen'
  json report.json '"add_face" in r["printed"]'
}

StrangersGuessesLeadOn() {
  run 0 generate quad-cube -o quad.obj
  run 2 quad.obj
  err 'limitcheck audit quad.obj'
  limitcheck audit quad.obj --depth 1 --level quick >out 2>err
  err 'all built-in subjects are audited on it'
  out $'\nrow-stream '
  run 2 audit gone.obj
  err 'there is no file gone.obj'
  run 0 help
  run 0 repair --help
  cp out repair
  run 0 help repair
  cmp out repair || fail 'another text'
  run 0 audit row-stream --option target=scalar quad.obj --depth 1 --level quick # the mesh is no option
}

# FOLDER LEAST: the folder has so many witnesses, of each of which both commands show it again.
shown_again() {
  local witness count=0 check command
  for witness in "$1"/*/witness.json; do
    ((++count))
    check=$(value "$witness" 'r["check"]')
    command=$(value "$witness" 'r["audit"]')
    each 1 <<<"${command#limitcheck } --json again.json"
    json again.json "any(x['check'] == '$check' and x['status'] == load('$witness')['status'] for x in rows)"
    command=$(value "$witness" 'r.get("eval", "")')
    [[ -n $command ]] || continue
    each 0 <<<"${command#limitcheck } --json"
    json out "all(r[k] == load('$witness')['limit_' + k] for k in ('position', 'normal'))"
  done
  holds $count -ge "$2"
}
# LEAST ARGUMENTS..: an audit with so many findings, each of which is shown again.
findings_shown_again() {
  run 1 audit "${@:2}" --depth 2 --level quick --witnesses found --json report.json
  local findings
  findings=$(value report.json 'sum(x["status"] == "finding" for x in rows)')
  holds "$findings" -ge "$1"
  holds "$(find found -name witness.json | wc -l)" = "$findings"
  shown_again found "$findings"
}

WitnessOfEveryFindingShowsItAgain() { findings_shown_again 5 opensubdiv-bfr bumpy:20 fan:1; }

WitnessIsWrittenWhereTheSurroundingsOfAFaceTouchThemselves() {
  findings_shown_again 2 model:mutation=mean_facet_normals torus:3:3 random:360:60
}

# Without the option the command would mean the polygons, and be about another surface.
WitnessNamesTheWayInWhichPolygonsWereCut() {
  run 0 generate pawn:5 -o pawn.obj
  run 1 audit opensubdiv-bfr pawn.obj --triangulate shortest-diagonal --depth 2 --level quick --witnesses found --json report.json
  shown_again found 3
  json report.json 'all(x["triangulated"] == "shortest-diagonal" for x in rows if x["status"] == "finding")'
  local command count=0
  while read -r command; do
    ((++count))
    each 1 <<<"${command#limitcheck }"
    [[ $command == *' pawn.obj '* ]] || fail "$command"
  done < <(value report.json '[x["witness"][k] for x in rows if x["status"] == "finding" and x["witness"]["difference"] for k in ("difference", "reproduce")]')
  holds $count -ge 4
  while read -r command; do
    each 0 <<<"${command#limitcheck } --json"
    json out "all(near(r['position'], x['witness']['expected']) for x in load('report.json')['results'] if x['check'] == 'positions' and x['witness'] and x['witness']['command'] == '$command')"
  done < <(value report.json '[x["witness"]["command"] for x in rows if x["status"] == "finding" and x["witness"]["difference"] and x["witness"]["command"]]')
}

# Quads, polygons, and triangles that are meant for Catmull-Clark's scheme.
WitnessOfCatmullClarksSurfacesShowsTheFindingAgain() {
  for meshes in 'quad-cube prism:5 mixed-pawn:5' 'octahedron --scheme catmull-clark'; do
    # shellcheck disable=SC2086
    findings_shown_again 1 quad-model:mutation=face_weight_1e-6 $meshes
    for witness in found/*/witness.json; do
      json "$witness" 'r["scheme"] == "catmull-clark"' '" --scheme catmull-clark" in r["audit"]'
    done
    rm -r found
  done
}

WitnessNamesTheFamilyOfWeightsAndTheDepthsOfFaces() {
  run 1 audit model:mutation=warren_declared octahedron --depth 1 --level quick --witnesses found
  shown_again found 1
  for witness in found/*/witness.json; do
    json "$witness" 'r["check"] != "positions" or "--weights warren" in r["eval"]'
  done
  run 1 audit sliding-window icosahedron --depth 2 --depths random:3 --option repair=none --level quick --witnesses depths
  shown_again depths 1
}

WitnessIsSmallAfterShrinking() {
  for audited in 'model:mutation=weight_1e-6_at_valence_5 random:5:300' 'quad-model:mutation=weight_1e-6_at_valence_5 mixed:4:300'; do
    each 1 <<<"audit $audited --depth 2 --level quick --shrink 60"
    err 'shrunk to'
    for mesh in limitcheck-witness/*/control.obj; do holds "$(grep -c '^f ' "$mesh")" -le 8; done
    shown_again limitcheck-witness 1
    rm -r limitcheck-witness
  done
}
