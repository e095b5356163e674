# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# `limitcheck audit --control --tessellation` on files as programs write them, and with one fault each.

FilesOfTheEngineHoldWithinTheRoundingOfFloat() {
  run 0 generate bumpy:200 -o cage.obj
  for file in out.ply out.obj; do
    run 0 tessellate cage.obj --depth 2 -o $file
    run 0 audit --control cage.obj --tessellation $file --normals --tolerance 1e-7 --per-vertex each.csv --json
    json out 'all(x["status"] == "held" for x in rows)'
    first vertex,distance,normal_angle,face,l1,l2 each.csv
    holds "$(wc -l <each.csv)" = $((1 + 2 + 8 * 200))
  done
}

FilesAreJudgedWithoutTheHausdorffDistanceIfAsked() {
  run 0 generate icosahedron -o cage.obj
  run 0 tessellate cage.obj --depth 1 -o out.ply
  run 0 audit --control cage.obj --tessellation out.ply --no-hausdorff --json
  json out 'len(rows) == 10' 'all(x["status"] == ("not-run" if x["check"] == "file-hausdorff" else "held") for x in rows)'
  run 2 audit --control cage.obj --tessellation out.ply --no-hausdorff --max-deviation 1
  run 1 audit --control cage.obj --tessellation cage.obj # the control mesh is no tessellation of itself
  out 'file-distance             FINDING'
}

# The limit points of the cube -1 .. 1 are its corners halved: 3/8 + 1/6 - 1/24 of 1 (three neighbours, three opposite corners
# of faces). Cut into triangles it has another surface.
FilesOfQuadsAreJudgedByCatmullClarksScheme() {
  run 0 generate quad-cube -o cage.obj
  awk '$1 == "v" { $2 /= 2; $3 /= 2; $4 /= 2 } { print }' cage.obj >limit.obj
  run 0 audit --control cage.obj --tessellation limit.obj --per-vertex each.csv
  out 'scheme: catmull-clark'
  first vertex,distance,normal_angle,face,corner,u,v each.csv
  run 0 audit --control cage.obj --tessellation limit.obj --provenance each.csv
  run 1 audit --control cage.obj --tessellation cage.obj
  run 1 audit --control cage.obj --tessellation limit.obj --triangulate fan
}

FilesThatAreBadOrMissingAreBadUsage() {
  run 0 generate icosahedron -o cage.obj
  echo 0,99,0,0 >map.csv
  printf 'ply\nformat ascii 1.0\n' >torn.ply
  run 0 tessellate icosahedron --depth 2 -o out.glb
  head -c 1000 out.glb >torn.glb
  refused audit <<'E'
--control cage.obj
--tessellation cage.obj
--control cage.obj --tessellation absent.ply
--control absent --tessellation cage.obj
--control cage.obj --tessellation torn.ply
--control cage.obj --tessellation torn.glb
--control cage.obj --tessellation cage.obj --provenance map.csv
--control cage.obj --tessellation cage.obj --tolerance 0
--control cage.obj --tessellation cage.obj --fit shear
naive --control cage.obj --tessellation cage.obj
E
  refused 'audit naive cage.obj' <<<--all-rows
  err '--all-rows has no effect without --json or --report'
}

# The page of a file shows its triangles, red where they are off: of twenty vertices moved, and of no other.
FilesHaveAPageThatShowsWhereTheyAreWrong() {
  run 0 generate bumpy:20 -o cage.obj
  run 0 tessellate cage.obj --depth 2 -o right.obj
  awk '/^v /{ if (++n > 50 && n <= 70) $2 += 0.001 } { print }' right.obj >moved.obj
  run 1 audit --control cage.obj --tessellation moved.obj --html page.html
  /usr/bin/python3 -c 'import base64, json, re
data = json.loads(re.search("id=\"data\">(.*?)</script>", open("page.html").read(), re.S).group(1))
shape = next(c["shape"] for c in data["causes"] if c["shape"])
values = base64.b64decode(shape["values"])
assert len(values) == 162 and sum(v > 0 for v in values) == 20, list(values)
assert len(base64.b64decode(shape["control"])) == 30 * 2 * 3 * 4
assert "the file has nothing of the kind" in data["legend"]' || fail 'the page'
}

# Every option that --help names has an effect on finished files, which is shown here, or is refused.
#   OPTION | its value | exit code of an audit of a file that has findings | what is then there
effects='
--control | cage.obj | - |
--tessellation | out.obj | - |
--normals | | 1 |
--provenance | map.csv | 1 |
--fit | | 1 |
--tolerance | 9 | 0 |
--channel-rule | all | 1 |
--max-deviation | 9 | 1 |
--no-hausdorff | | 1 |
--per-vertex | each.csv | 1 | each.csv
--scheme | catmull-clark | 1 |
--triangulate | fan | 1 |
--threads | 1 | 1 |
--json | new.json | 1 | new.json
--details | | 1 |
--all-rows | --json all.json | 1 | all.json
--color | always | 1 |
--sarif | log.sarif | 1 | log.sarif
--markdown | page.md | 1 | page.md
--require | file-normals | 1 |
--junit | junit.xml | 1 | junit.xml
--html | page.html | 1 | page.html
--witnesses | found | 1 | found
--waivers | waivers.json | 0 |
--baseline | old.json | 0 |
--save-baseline | known.txt | 1 | known.txt
--explain | normals | 0 |
--help | | 0 |
--depth | 2 | refused |
--depths | uniform | refused |
--sample | 9 | refused |
--exhaustive | 3 | refused |
--option | a=b | refused |
--shard | 1/2 | refused |
--resume | | refused |
--level | quick | refused |
--shrink | 1 | refused |
--report | all | refused |
--program | true | refused |
--timeout | 1 | refused |
--memory | 9 | refused |
--containment | auto | refused |
--witness-folder | x | refused |
--checks | normals | refused |
--rerun | old.json | refused |
--shader | x.glsl | refused |
--isolate | | refused |
--must-refuse | | refused |
--require-coverage | | refused |
'
FilesFeelEveryOptionOrRefuseIt() {
  run 0 generate bumpy:20 -o cage.obj
  run 0 tessellate cage.obj --depth 1 -o out.obj
  local wrong='audit --control cage.obj --tessellation cage.obj' option value code file seen=0
  each 1 <<<"$wrong --json old.json"
  echo '{"waivers": [{"subject": "cage.obj", "check": "*", "reason": "known", "expires": "2999-01-01"}]}' >waivers.json
  echo 0,0,0,0 >map.csv
  while read -r option; do
    ((++seen))
    IFS='|' read -r _ value code file < <(grep -- "^$option |" <<<"$effects") || fail "$option has no effect that is known"
    case ${code// /} in
      refused) each 2 err "$option has no effect on finished tessellations" <<<"$wrong $option $value" ;;
      -) ;;
      *) each "${code// /}" <<<"$wrong $option $value" ;;
    esac
    [[ -z ${file// /} ]] || holds -e "${file// /}"
  done < <(limitcheck audit --help | sed -nE 's/^ +(-[a-z],)?(--[a-z-]+).*/\2/p' | sort -u)
  holds $seen = "$(grep -c '^--' <<<"$effects")"
  run 0 audit --control cage.obj --tessellation out.obj
  run 2 audit --control cage.obj --tessellation out.obj --require file-positions # without a provenance there is no such row
}

FilesAreSubjectsOfOneReport() {
  run 0 generate bumpy:20 -o cage.obj
  run 0 tessellate cage.obj --depth 1 -o out.obj
  run 1 audit --control cage.obj --tessellation out.obj --tessellation cage.obj --json
  json out 'r["subjects"] == ["out.obj", "cage.obj"]' 'all(x["subject"] == "cage.obj" or x["status"] == "held" for x in rows)'
  mkdir all
  cp out.obj cage.obj all
  run 1 audit --control cage.obj --tessellation all --json
  json out 'r["subjects"] == ["all/cage.obj", "all/out.obj"]'
  refused audit <<<'--control cage.obj --tessellation all --per-vertex each.csv'
}

FilesInGlbComeBackAsTheyWere() {
  run 0 generate bumpy:20 -o cage.obj
  for file in out.glb out.ply; do
    run 0 tessellate cage.obj --depth 2 -o $file
    run 0 audit --control cage.obj --tessellation $file --tolerance 1e-7 --normals --json $file.json
  done
  # The same floats, and as many vertices.
  json out.glb.json 'all(row(c)[k] == next(x for x in load("out.ply.json")["results"] if x["check"] == c)[k] for c, k in (("file-distance", "worst"), ("file-normals", "worst"), ("file-finite", "of")))'
}

# CODE ARGUMENTS..: an audit of a tessellation of cage.obj, to report.json.
audit() { run "$1" audit --control cage.obj --tolerance 1e-7 --json report.json --tessellation "${@:2}"; }
findings='[x["check"] for x in rows if x["status"] == "finding"]'

# Every face has vertices of its own, pairs of triangles are quads, there are no normals, the unit is another.
FilesOfAGameEngineHoldOnceScaleAndOffsetAreFittedAway() {
  run 0 generate bumpy:20 -o cage.obj
  run 0 tessellate cage.obj --depth 2 -o good.obj
  /usr/bin/python3 >engine.obj <<'PYTHON'
lines = [line.split() for line in open("good.obj")]
positions = [[100 * float(x) + o for x, o in zip(w[1:], (5, -7, .25))] for w in lines if w[0] == "v"]
faces = [[int(v.split("/")[0]) - 1 for v in w[1:]] for w in lines if w[0] == "f"]
of_edge = {(f[k], f[(k + 1) % 3]): n for n, f in enumerate(faces) for k in range(3)}
done, out, count = set(), [], 0
for n, (a, b, c) in enumerate(faces):
    if n in done:
        continue
    corners, other = [a, b, c], of_edge.get((a, c))
    done.add(n)
    if other is not None and other not in done:
        corners.append(next(v for v in faces[other] if v not in (a, c)))
        done.add(other)
    for v in corners:
        print("v", *positions[v])
    out.append(range(count + 1, count + 1 + len(corners)))
    count += len(corners)
assert sum(len(f) == 4 for f in out) > 100
for f in out:
    print("f", *f)
PYTHON
  audit 1 engine.obj
  audit 0 engine.obj --fit scale --per-vertex each.csv
  json report.json 'row("file-distance")["worst"] <= 1e-7' 'row("file-normals")["status"] == "not-supported"'
  holds "$(wc -l <each.csv)" = $((1 + $(grep -c '^v ' engine.obj)))
  audit 1 engine.obj --fit scale --normals
  json report.json "$findings == ['file-normals']"
}

# The provenance that --per-vertex finds, given back, is a provenance.
FilesTakeTheParametersThatWereFoundAsProvenance() {
  run 0 generate bumpy:20 -o cage.obj
  run 0 tessellate cage.obj --depth 2 -o good.obj
  audit 0 good.obj --per-vertex each.csv
  cut -d , -f 1,4- each.csv >map.csv
  audit 0 good.obj --provenance map.csv
  json report.json "row('file-positions')['of'] == $(grep -c '^v ' good.obj)"
  # Two rows exchanged: still on the surface, but not where they say.
  awk -F , -v OFS=, 'NR == 12 { $1 = 11 } NR == 13 { $1 = 10 } { print }' map.csv >swapped.csv
  audit 1 good.obj --provenance swapped.csv
  json report.json "'file-positions' in $findings"
}

# PROGRAM CHECKS..: of awk, which makes a fault in the file; these checks are red.
sees() {
  awk -v CONVFMT=%.17g "$1" good.obj >bad.obj
  audit 1 bad.obj
  for check in "${@:2}"; do json report.json "'$check' in $findings"; done
}
# shellcheck disable=SC2016
FilesWithOneFaultTurnTheChecksRedThatAreMeantForIt() {
  run 0 generate bumpy:20 -o cage.obj
  run 0 tessellate cage.obj --depth 2 -o with_normals.obj
  sed -E '/^vn/d; s,//[0-9]+,,g' with_normals.obj >good.obj
  sees '!/^f/ || ++n != 101' file-coverage file-watertight
  sees '/^f/ && ++n == 201 { t = $2; $2 = $3; $3 = t } { print }' file-orientation file-watertight
  sees '/^v/ && ++n == 101 { for (k = 2; k < 5; ++k) $k *= 1 + 1e-5 } { print }' file-distance # outwards of a sphere
  json report.json "$findings == ['file-distance']"
  # Two neighbours in each other's place: every vertex on the surface, every edge shared by two triangles, and the faces those
  # of the mesh; so neither is where it should be.
  local a b
  read -r _ a b _ < <(grep '^f' good.obj | sed -n 251p)
  sees "/^v/ && ++n { at[n] = \$0; next } /^f/ && !done { t = at[$a]; at[$a] = at[$b]; at[$b] = t; for (k = 1; k <= n; ++k) print at[k]; done = 1 } { print }" file-distance
}
