# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# Every command that takes a control mesh chooses the scheme by the mesh, says so first, and cuts no polygon unless it is told to.
loop='scheme: loop (all faces are triangles)'
catmull_clark='scheme: catmull-clark (not all faces are triangles)'

SchemeIsTheFirstLineOfEveryCommand() {
  run 0 tessellate octahedron --depth 2 -o out.ply
  each 0 first "$loop" <<'E'
tessellate octahedron --depth 1
audit naive octahedron --depth 1 --level quick
audit model --depth 1 --level quick
eval octahedron 0 0 0
audit --control octahedron --tessellation out.ply
E
  run 0 generate octahedron -o o.obj
  first "$loop" err
}

SchemeOfLoopTakesPolygonsThatAreCutOnRequestAndSaysHowMany() {
  run 0 tessellate quad-cube --triangulate fan --depth 2 -o out.ply
  each 0 first 'scheme: loop (--triangulate fan cut 6 faces into triangles)' <<'E'
tessellate quad-cube --depth 1 --triangulate fan
eval quad-cube 0 0 0 --triangulate fan
audit naive quad-cube --depth 1 --level quick --triangulate fan
audit --control quad-cube --tessellation out.ply --triangulate fan
E
  run 0 tessellate quad-cube --depth 1 --triangulate fan --json
  json out '(r["scheme"], r["faces_cut"], r["faces"]) == ("loop", 6, 12)'
}

# Files and names alike.
SchemeRefusesPolygonsForLoopsInASentenceThatNamesTheWaysOut() {
  run 0 generate quad-cube -o cube.ply
  run 0 tessellate octahedron --depth 1 -o out.ply
  for mesh in quad-cube cube.ply; do
    for command in "tessellate $mesh" "audit naive $mesh" "eval $mesh 0 0 0" "audit --control $mesh --tessellation out.ply"; do
      refused "$command" <<<'--scheme loop'
      err '6 of 6 faces are no triangles' 'leave out --scheme loop' '--triangulate fan'
    done
  done
}

SchemeOfATessellationIsThatOfTheMesh() {
  for mesh in quad-cube prism:5 creased-cube creased-cube:2 mixed-sharp:3; do
    run 0 tessellate --depth 2 --json $mesh
    json out '(r["scheme"], r["engine"]) == ("catmull-clark", "row-stream")' 'r["triangles"] > 0'
  done
  each 0 <<'E'
tessellate octahedron --scheme catmull-clark
tessellate corner:3
tessellate dart:5
E
  run 2 tessellate sharp:3 # silence would be the surface without the edges
  err semi-sharp
}

# What is written is the surface: the audit judges the files like anybody's.
SchemeOfQuadsIsRight() {
  for mesh in quad-cube prism:5; do
    for file in out.ply out.glb; do
      run 0 tessellate $mesh --depth 3 -o $file
      run 0 audit --control $mesh --tessellation $file
    done
  done
}

SchemeOfAnAuditIsThatOfEachMesh() {
  run 0 generate prism:5 -o prism.off
  run 0 audit naive --depth 2 --level quick quad-cube prism.off
  first "$catmull_clark"
  run 0 audit naive --depth 2 --level quick octahedron prism.off cube
  first 'scheme: loop (2 of 3 meshes, whose faces are all triangles), catmull-clark (1)'
  run 0 audit naive --depth 2 --level quick octahedron --scheme catmull-clark
  first 'scheme: catmull-clark (--scheme)'
  run 0 audit naive --depth 2 --level quick octahedron prism.off --json
  json out '[m["scheme"] for m in r["meshes"]] == ["loop", "catmull-clark"]' 'r["meshes"][1]["triangulated"] is None' \
    'all(x["scheme"] == ("loop" if x["mesh"] == "octahedron" else "catmull-clark") for x in rows)'
  run 0 audit naive --depth 2 --level quick prism.off --triangulate fan --json
  json out '(r["meshes"][0]["triangulated"], r["meshes"][0]["faces"]) == ("fan", 16)'
}

SchemeOfASubjectThatDoesLoopsOnlyLeadsToTriangulate() {
  run 2 audit model quad-cube --depth 1 --level quick
  out "does Loop's scheme only needs --triangulate"
  run 0 audit model quad-cube --depth 1 --level quick --triangulate fan
  run 2 audit model quad-cube cube --depth 1 --level quick
  out '14 held, 0 findings' # the cube is judged
  err 'nothing was judged on quad-cube: model: does not subdivide by catmull-clark'
}

SchemeOfBrokenMeshesIsChosenLikewise() {
  printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 2 3 4 1\n' >twice.obj
  run 0 audit naive twice.obj --must-refuse
  first "$catmull_clark"
  run 0 audit naive twice.obj --must-refuse --triangulate shortest-diagonal
  first 'scheme: loop (--triangulate shortest-diagonal cut 2 faces into triangles)'
  run 0 generate quad-cube -o cube.obj
  run 2 audit naive cube.obj --must-refuse               # nothing is wrong with it
  run 0 audit naive cube.obj --must-refuse --scheme loop # no mesh for Loop's scheme
}

# As polygons this is a disc; cut from their first corners the two quads both get the edge 1-3.
SchemeRefusesWhatIsNoManifoldOnceItIsCut() {
  printf 'v 0 0 0\nv 1 -1 0\nv 2 0 0\nv 1 1 0\nv 1 1 1\nv 1 -1 1\nf 1 2 3 4\nf 1 5 3 6\nf 1 4 5\nf 4 3 5\n' >book.obj
  run 0 eval book.obj 0 0 0
  run 2 tessellate book.obj --triangulate fan
  err 'edge 1–3 has 4 faces (1, 1, 2, 2)'
}
