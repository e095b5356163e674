# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# `limitcheck generate`, `check` and `repair`.

# F = 2V - 4 on a closed surface of genus 0.                                                                            [C71]
GenerateWritesABumpySphereInEveryFormat() {
  for file in a.obj a.off a.ply; do
    run 0 generate bumpy:200 -o $file
    run 0 check --json $file
    json out '(r["valid"], r["faces"], r["vertices"]) == (True, 200, 102)'
  done
}

GenerateTakesASeedThatDecidesTheMesh() {
  run 0 generate bumpy:200 -o a.obj --seed 7
  run 0 generate bumpy:200 -o b.obj --seed 7
  run 0 generate bumpy:200 -o c.obj --seed 8
  cmp a.obj b.obj || fail 'one seed, two meshes'
  ! cmp -s a.obj c.obj || fail 'two seeds, one mesh'
}

GenerateWritesPolygonsAsPolygonsInEveryFormat() {
  for file in a.obj a.off a.ply; do
    run 0 generate cube-quads -o $file
    first 'scheme: catmull-clark (not all faces are triangles)' err
    run 0 check --json $file
    json out 'r["face_sizes"] == {"4": 6}'
    run 0 repair $file -o $file.obj
    cmp $file.obj a.obj.obj || fail 'another mesh'
  done
  run 0 generate cube-quads -o b.obj --triangulate fan
  first 'scheme: loop (--triangulate fan cut 6 faces into triangles)' err
  holds "$(grep -c '^f ' b.obj)" = 12
  run 0 generate dual:bumpy:20 -o c.obj --seed 5
  holds -s c.obj
  run 2 generate cube-quads -o a.stl
  err 'STL is read, not written'
}

GenerateRefusesAndLeavesWhatIsThere() {
  echo precious >keep.obj
  refused generate <<'E'

no-such-shape -o keep.obj
bumpy:3 -o keep.obj
bumpy:201 -o keep.obj
wheel:2 -o keep.obj
wheel:-7 -o keep.obj
wheel:x -o keep.obj
quad-cube -o keep.obj --scheme loop
dual:triangle -o keep.obj
octahedron -o keep.obj --scheme doo-sabin
icosahedron -o keep.xyz
icosahedron -o absent/a.obj
E
  holds "$(<keep.obj)" = precious
}

GenerateSaysWhatBecomesOfChannels() {
  run 0 generate uvs:1:cube -o c.ply
  err 'no place for the rule of the channel uv, the channel colour'
  run 0 generate uv-torus -o torus.obj
  run 0 check torus.obj
  out 'uv: '
  run 0 check torus.obj --json
  json out 'r["channels"][0]["components"] == 2'
  run 0 tessellate torus.obj --depth 1 -o fine.obj
  err 'fine.obj has none'
  run 0 repair torus.obj -o again.obj
  cmp again.obj torus.obj || fail 'repaired, though nothing was wrong'
}

# Faces 2 and 4 (lines 6 and 8) are at fault, and so is vertex 5.
broken() { printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 9\nf 1 2 4\nf 3 3 4\nf 2 3 4\nf 1 4 3\nv 7 7 7\n' >broken.obj; }

CheckListsEveryFaultWithItsLineAndCountsAsTheFileDoes() {
  broken
  run 1 check broken.obj
  out 'broken.obj:6: MESH_INDEX_OUT_OF_RANGE: face 2 names vertex 9' 'broken.obj:8: MESH_DEGENERATE_FACE: face 4 names vertex 3 twice' \
    'broken.obj:11: MESH_ISOLATED_VERTEX: no face names vertex 5' 'counted from 1'
  run 1 check broken.obj --json
  json out '(len(r["faults"]), len(r["warnings"]), r["valid"], r["numbers_from"]) == (2, 1, False, 1)'
}

# The first of the tetrahedron's five, and the last.
CheckLeavesOutUnusedVerticesAsNoFault() {
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n' >used.obj
  printf 'v 7 7 7\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 9 9 9\nf 2 4 3\nf 2 3 5\nf 3 4 5\nf 2 5 4\n' >unused.obj
  cat >unused.ply <<'E'
ply
format ascii 1.0
element vertex 6
property float x
property float y
property float z
element face 4
property list uchar int vertex_indices
end_header
7 7 7
0 0 0
1 0 0
0 1 0
0 0 1
9 9 9
3 1 3 2
3 1 2 4
3 2 3 4
3 1 4 3
E
  run 0 audit sliding-window used.obj --depth 2 --json used.json
  run 0 eval used.obj 0 1/3 1/3 --json
  cp out used.point
  for mesh in unused.obj unused.ply; do
    run 0 audit sliding-window $mesh --depth 2 --json -
    json out 'r["meshes"][0]["vertices"] == 4' \
      '[(x["check"], x["worst"]) for x in rows] == [(x["check"], x["worst"]) for x in load("used.json")["results"]]'
    run 0 audit sliding-window $mesh --depth 1 --level quick
    holds "$(<err)" = "limitcheck: warning: $mesh: 2 vertices that no face names are left out"
    run 0 check $mesh
    out 'unused vertices     2, which an audit leaves out'
    run 0 tessellate $mesh -o fine.ply --depth 2
    run 0 audit --control $mesh --tessellation fine.ply
    run 0 eval $mesh 0 1/3 1/3 --json
    json out 'r["position"] == load("used.point")["position"]'
  done
}

CheckSummarisesAMeshWithoutFaults() {
  run 0 generate octahedron -o o.ply
  run 0 check o.ply
  out 'none: the mesh is closed'
  run 0 check o.ply --json
  json out 'r["valid"]' 'r["vertices"] == 6' 'r["interior_valences"]["4"] == 6' 'r["euler_characteristic"] == 2'
}

# Two quads and a third face on the edge that they share.
CheckNamesPolygonsNotTheTrianglesTheyBecome() {
  printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nv 1 0 1\nf 1 2 3 4\nf 2 5 6 3\nf 3 2 7\n' >book.obj
  run 1 check book.obj
  out 'edge 2–3 has 3 faces (1, 2, 3)'
}

CheckJudgesAMeshByItsSchemeAndCountsItsFacesBySize() {
  run 0 generate prism:5 -o prism.obj
  run 0 check prism.obj
  first 'scheme: catmull-clark (not all faces are triangles)'
  out '7; by corners: 5 of 4, 2 of 5' 'by neighbours: 10 of 3'
  run 1 check prism.obj --scheme loop
  first 'scheme: loop (--scheme)'
  out 'prism.obj:11: MESH_POLYGON: face 1 has 5 corners'
  run 0 check prism.obj --triangulate shortest-diagonal
  first 'scheme: loop (--triangulate shortest-diagonal cut 7 faces into triangles)'
  # Triangles are as ever those that the faces of the file give when they are cut.
  run 0 check prism.obj --json
  json out '(r["scheme"], r["faces_cut"], r["triangles"]) == ("catmull-clark", 0, 16)' 'r["face_sizes"] == {"4": 5, "5": 2}' \
    'r["euler_characteristic"] == 2'
  run 0 check prism.obj --json --triangulate fan
  json out '(r["scheme"], r["faces_cut"], r["triangles"]) == ("loop", 7, 16)'
  run 1 check prism.obj --json --scheme loop
  json out 'len(r["faults"]) == 7'
}

CheckChoosesTheSchemeByFacesThatAreAtFaultToo() {
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4 2\n' >twice.obj
  run 1 check twice.obj
  out 'scheme: catmull-clark'
}

CheckRefusesWhatIsNoMesh() {
  echo 'v 1 2' >x.obj
  refused check <<'E'
x.obj
absent.obj

x.xyz
E
}

CheckCallsAPointCloudOne() {
  printf 'ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n' >cloud.ply
  echo 'v 0 0 0' >cloud.obj
  for file in cloud.ply cloud.obj; do
    run 1 check $file
    out 'MESH_EMPTY: a point cloud: 1 vertices and no faces'
    lacks closed
  done
}

# Which has a vertex for each normal: without them being one there would be a seam.
CheckTakesAControlMeshInGltf() {
  run 0 tessellate octahedron --depth 1 --no-cull -o cage.glb
  run 0 check cage.glb
  out 'none: the mesh is closed'
  run 0 audit naive cage.glb --depth 1 --level quick
  run 0 repair cage.glb -o cage.obj
}

# Each line that `help tags` shows is read, and check says so where it is an edge or a vertex.
CheckCountsTheTagsOfTheHelp() {
  run 0 help tags
  cp out help
  run 0 generate quad-cube -o cube.obj
  local tags=0 tag a b
  read -r _ a b _ < <(grep '^f ' cube.obj)
  while read -r tag; do
    ((++tags))
    tag=${tag%%   *}
    tag=${tag/ A / $((a - 1)) } tag=${tag/ B / $((b - 1)) } tag=${tag/ V / 3 }
    tag=${tag/% S/ 23/10} tag=${tag/% F/ 5}
    { cat cube.obj; echo "$tag"; } >tagged.obj
    run 0 check tagged.obj
    if [[ $tag == *'crease '* ]]; then out $'sharp edges         1 semi-sharp (2.3)\n'; else lacks 'sharp edges'; fi
    if [[ $tag == *'corner '* ]]; then out $'sharp vertices      1 semi-sharp (2.3)\n'; else lacks 'sharp vertices'; fi
    [[ $tag != *'hole '* ]] || run 0 audit naive tagged.obj --depth 1 --level quick
  done < <(grep '^  t ' help)
  holds $tags = 6
  run 2 help tag
  err "there is no command 'tag'"
  run 0 help eval
  out --digits
}

CheckCutsLongListsOfFaultsAndJsonHasThemAll() {
  { printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\n'; for ((k = 0; k < 400; ++k)); do echo 'f 1 2 3'; done; } >many.obj
  run 1 check many.obj
  holds "$(wc -l <out)" -lt 60
  out ' more; limitcheck check many.obj --json has them all'
  run 1 check many.obj --json
  json out 'len(r["faults"]) > 300'
}

RepairMakesAMeshThatAnAuditTakes() {
  broken
  run 2 audit row-stream broken.obj --depth 1 --level quick
  run 0 repair broken.obj -o fixed.obj
  out 'dropped 1 face that named a vertex which does not exist'
  run 0 check fixed.obj
  run 0 audit row-stream fixed.obj --depth 1 --level quick
  run 0 repair fixed.obj -o again.obj
  out $'\nnothing had to be changed\n'
}

RepairWeldsTheBorderWithinADistanceIfItIsGivenOne() {
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1e-16 0 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 0 1e-16 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\n' >strip.obj
  run 0 repair --weld 1e-6 strip.obj -o a.obj
  out '6 vertices, 3 faces'
  each 0 out '8 vertices, 3 faces' <<'E'
repair --weld strip.obj -o b.obj
repair strip.obj -o b.obj --weld
E
  refused repair <<'E'
strip.obj -o b.obj --weld nan
strip.obj -o b.obj --weld 1
-o b.obj --weld 1e-6
strip.obj -o b.obj --weld -1
strip.obj -o b.obj --weld much
E
}

# Two triangles back to back: the later of the two faces is a duplicate, and goes.
RepairSaysWhatItDropped() {
  printf 'OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n' >pillow.off
  run 0 repair pillow.off -o out.off
  out 'dropped 1 face with the corners of a face before it'
}

RepairKeepsPolygonsInEveryFormat() {
  printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nv 9 9 9\nf 1 2 3 4\nf 2 5 6 3\n' >quads.obj
  for file in a.obj a.off a.ply; do
    run 0 repair quads.obj -o $file
    run 0 check --json $file
    json out 'r["face_sizes"] == {"4": 2}' 'r["vertices"] == 6'
  done
}

RepairCutsPolygonsOnlyIfItIsTold() {
  run 0 generate quad-cube -o cube.off
  run 0 repair cube.off -o kept.off
  first 'scheme: catmull-clark (not all faces are triangles)'
  out '8 vertices, 6 faces'
  cmp kept.off cube.off || fail 'another mesh'
  run 0 repair cube.off -o cut.off --triangulate fan
  first 'scheme: loop (--triangulate fan cut 6 faces into triangles)'
  out '8 vertices, 12 faces'
  run 1 repair cube.off -o loop.off --scheme loop # faults are left, for Loop's scheme
  out MESH_POLYGON
}

RepairLeavesWhatIsThereWhenItCannotWrite() {
  broken
  echo precious >keep.stl
  run 2 repair broken.obj -o keep.stl
  run 2 repair absent.obj -o keep.stl
  holds "$(<keep.stl)" = precious
}
