# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# `limitcheck eval`: how a point and a channel are asked for, and what is wrong with a question. (What it answers: eval_test.cpp.)

EvalTakesAPointInAnyForm() {
  for point in '1/4 1/2' '0.25 0.5' '2/8 5e-1'; do
    each 0 <<<"eval bumpy:200 17 $point --json"
    [[ $point == 1/4* ]] && cp out first_form
    json out 'r["position"] == load("first_form")["position"]'
  done
}

# Faces whose surroundings touch themselves in a vertex.
EvalTakesEveryFaceOfAValidMesh() {
  each 0 <<'E'
eval torus:3:3 0 1/3 1/3
eval random:360:60 1 1/3 1/3
eval octahedron 0 1/3 1/3
E
}

# The middle of a face is the corner (1, 1) of all its quads, that of an edge (1, 0) of one and (0, 1) of the next.
EvalTakesACornerWhereAFaceIsNoQuad() {
  local one other
  while IFS='|' read -r one other; do
    each 0 <<<"eval $one --json"
    cp out one
    each 0 <<<"eval $other --json"
    json out 'r["position"] == load("one")["position"]'
  done <<'E'
prism:5 0:0 1 1|prism:5 0:3 1 1
prism:5 0:1 1 0|prism:5 0:2 0 1
octahedron 3:2 1 0 --scheme catmull-clark|octahedron 3:0 0 1 --scheme catmull-clark
E
  run 0 eval octahedron 3 1/4 1/4 --json
  cp out loop
  run 0 eval octahedron 3:2 1/4 1/4 --scheme catmull-clark --json
  json out 'r["position"] != load("loop")["position"]'
  run 0 eval prism:5 0:2 1/3 1/4
  out $'scheme: catmull-clark (not all faces are triangles)\nprism:5 face 0 corner 2 at (1/3, 1/4)\n' 'd/du ' 'd2/dudv '
  run 0 eval octahedron 0 0 0
  first 'scheme: loop (all faces are triangles)'
  run 0 eval octahedron 0 0 0 --json
  json out 'r["scheme"] == "loop"'
  run 0 eval prism:5 0 0 0 --triangulate fan --json
  json out 'r["faces_cut"] == 7'
}

EvalSaysWhatIsWrongWithAFaceAndItsParameters() {
  local arguments words
  while IFS='|' read -r arguments words; do
    refused eval <<<"$arguments"
    err "$words"
  done <<'E'
prism:5 2:0 0 0|face 2 is a quad
prism:5 0 0 0|FACE is 0:0 to 0:4
prism:5 0:5 0 0|face 0 has corners 0 to 4, not 5
prism:5 0:-1 0 0|face 0 has corners 0 to 4, not -1
prism:5 7 0 0|has faces 0 to 6, not 7
prism:5 2 5/4 0|must be in 0..1
prism:5 2 0 -1/4|must be in 0..1
prism:5 0: 0 0|FACE:CORNER
prism:5 0:1x 0 0|FACE:CORNER
octahedron 0:0 0 0|for Catmull-Clark's scheme
octahedron 0 0 0 --weights hoppe|--weights
prism:5 2 0 0 --weights warren|--weights warren is for Loop's scheme
prism:5 2 0 0 --scheme loop|7 of 7 faces are no triangles
quad-cube 0 0 0 --channel uv|it has none
E
}

EvalRefusesBadInput() {
  printf 'v 0 0 0\nv 1e39 0 0\nv 0 1 0\nf 1 2 3\n' >far.obj
  run 0 eval far.obj 0 1/3 1/3
  refused eval <<'E'

tetrahedron
tetrahedron 4 0 0
tetrahedron -1 0 0
tetrahedron 0 2/3 2/3
tetrahedron 0 -1/3 1/3
tetrahedron 0 1/0 0
tetrahedron 0 abc 0
tetrahedron 0 nan 0
tetrahedron 0 0 0 --digits 0
tetrahedron 0 0 0 --digits 1000000000
tetrahedron 99999999999999999999 0 0
no-such-file.obj 0 0 0
far.obj 0 1/3 1/3 --precision float
E
  err 'vertex 1'
}

# Two quads with a chart each: a value of one face is held, and each side of the seam has its own.
two_charts() {
  printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nvt 0 0\nvt .5 0\nvt .5 1\nvt 0 1\nvt .625 0\nvt 1 0\nvt 1 1\nvt .625 1\nf 1/1 2/2 5/3 4/4\nf 2/5 3/6 6/7 5/8\n' >two.obj
}

EvalOfAChannelHasAValueOnEachSideOfASeam() {
  two_charts
  run 0 eval two.obj 0 1 0 --channel uv --json
  json out 'r["channel"] == "uv"' 'r["channel_rule"] == "corners-plus1"' 'len(r["position"]) == 2' \
    'float(r["position"][0]) == .5' '"normal" not in r' # the rule is USD's, as the file says none
  run 0 eval two.obj 1 0 0 --channel uv --json
  json out 'float(r["position"][0]) == .625' 'float(r["d1"][0]) == .375'
  # By the rule "none" a value of one face is a B-spline curve's: 2/3 v + 1/6 (a + b).
  run 0 eval two.obj 0 1 0 --channel uv --channel-rule none --json
  json out 'near(r["position"], [.5 * 2 / 3 + .5 / 6, 1 / 6])'
  run 0 eval two.obj 0 1/2 1/2 --channel uv --channel-rule all
  out $'channel uv by the rule all\nvalue       0.2500000000000000  0.5000000000000000  '
}

EvalOfAChannelThatIsNoneOrCannotBeHasAClearError() {
  two_charts
  local options words
  while IFS='|' read -r options words; do
    refused 'eval two.obj 0 0 0' <<<"$options"
    err "$words"
  done <<'E'
--channel ''|--channel: it is empty
--channel st|the mesh has no channel 'st'; it has uv
--channel uv --channel-rule smooth|--channel-rule
--channel-rule all|--channel
E
}

# Of each line what eval says of its point, in double and certified, as CSV and as JSON.
EvalOfAFileOfPointsSaysOfEachWhatIsSaidOfItAlone() {
  local vectors='normal d1 d2 d11 d12 d22' header=face,u,v,x,y,z k
  for k in $vectors; do header+=,${k}_x,${k}_y,${k}_z; done
  for mesh in bumpy:200 dual:icosahedron; do
    if [[ $mesh == bumpy:200 ]]; then
      printf '17,1/4,1/2\n0, 0.1 ,0.2\n199,1/3,1/3\n' >points
    else
      printf '0:1,1/4,1/2\n1:2,0.1,0.2\n2:0,1/3,1/3\n' >points
    fi
    { printf 'face,u,v\n# a comment\n'; sed 's/$/\r/' points; } >points.csv
    run 0 eval $mesh --points points.csv --derivatives 2 --certified --json
    cp out certified
    run 0 eval $mesh --points points.csv --derivatives 2
    first "$header",gaussian_curvature,mean_curvature
    cp out csv
    tr , ' ' <points | while read -r point; do
      each 0 <<<"eval $mesh $point --json"
      tr -d '\n' <out
      echo
    done >alone
    # Doubles: StamError bounds derivatives by 1e-12 of the diagonal; curvatures are quotients of some of them.
    /usr/bin/python3 - <<'PYTHON' || fail "$mesh"
import json
vectors, numbers = "position normal d1 d2 d11 d12 d22".split(), ["gaussian_curvature", "mean_curvature"]
lines = list(zip(open("alone"), open("certified"), list(open("csv"))[1:], strict=True))
assert len(lines) == 3
for alone, certified, csv in lines:
    alone, certified = json.loads(alone), json.loads(certified)
    assert all(alone[k] == certified[k] for k in vectors + numbers)
    expected = [x for k in vectors for x in alone[k]] + [alone[k] for k in numbers]
    assert all(abs(float(a) - float(b)) < 1e-9 for a, b in zip(csv.split(",")[3:], expected, strict=True)), csv
PYTHON
  done
  two_charts
  printf '0,1,0\n1,0,0\n' >points.csv
  run 0 eval two.obj --points points.csv --channel uv --derivatives 1 --channel-rule all --digits 4
  holds "$(<out)" = $'face,u,v,value_0,value_1,d1_0,d1_1,d2_0,d2_1\n0,1,0,0.5000,0,0.5000,0,0,1.000\n1,0,0,0.6250,0,0.3750,0,0,1.000'
}

EvalNamesALineThatIsNoPointAndWritesTheLinesBeforeIt() {
  local points lines words
  while IFS='|' read -r points lines words; do
    printf '%b' "$points" >points.csv
    run 2 eval icosahedron --points points.csv
    err "$words"
    holds "$(wc -l <out)" = "$lines"
  done <<'E'
0,0,0\n0,1,x\n0,0,0\n|2|points.csv:2: POINT_UNUSABLE: 'x' is not a number
\n\n20,0,0|1|points.csv:3: POINT_UNUSABLE: icosahedron has faces 0 to 19, not 20
0,1,1e-3\n|1|points.csv:1: POINT_UNUSABLE: l1, l2 must be >= 0 and l1 + l2 <= 1
0,0\n|1|points.csv:1: POINT_UNUSABLE: a line is FACE,U,V, not '0,0'
0,0,0,0\n|1|a line is FACE,U,V
0,0,nan\n|1|points.csv:1: POINT_UNUSABLE
E
  run 2 eval icosahedron --points .
  err FILE_NOT_READABLE
  run 2 eval icosahedron
  err 'FACE U V are missing'
  # Many blocks: each line in its place.
  awk 'BEGIN { for (k = 0; k < 300000; ++k) print k % 20 ",0.25," k % 3 / 4 }' >points.csv
  run 0 eval icosahedron --points points.csv
  tail -n +2 out | cut -d , -f 1-3 | cmp - points.csv || fail 'a line is not in its place'
}

# The commands of README.md that evaluate a point without a subject.
EvalAnswersTheCommandsOfTheReadme() {
  run 0 generate pawn -o cage.obj
  local line commands=0
  while read -r line; do
    ((++commands))
    each 0 <<<"${line#limitcheck }"
  done < <(grep '^limitcheck eval ' "$SOURCE/README.md" | grep -v -- --subject)
  holds $commands -ge 2
}
