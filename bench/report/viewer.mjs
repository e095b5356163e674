// SPDX-License-Identifier: MIT
// The report's view in three dimensions: orbit with the mouse, a finger or the keyboard; colours by what is chosen; buttons of
// the audit's table (class jump) show a witness on the surface it lies on.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
// What the page holds, packed; positions are steps in a box.
const points = ({ low, step, steps }) => Float32Array.from(new Int16Array(bytes(steps)), (n, k) => low[k % 3] + step * (n + 32768));
const unpacked = (id) => new Response(new Blob([bytes(document.getElementById(id).textContent)]).stream().pipeThrough(new DecompressionStream("gzip"))).json();

// Dark to light, readable without colour vision (viridis).
const stops = ["#440154", "#3b528b", "#21918c", "#5ec962", "#fde725"].map((c) => new THREE.Color(c));
function ramp(t) {
  const x = Math.min(Math.max(t, 0), 1) * (stops.length - 1), k = Math.min(Math.floor(x), stops.length - 2);
  return stops[k].clone().lerp(stops[k + 1], x - k);
}
const kinds = ["#21618c", "#c0392b", "#d9730d", "#7d3c98"].map((c) => new THREE.Color(c));
const frame = document.getElementById("viewer").dataset;
const depths = JSON.parse(frame.depths).map((c) => new THREE.Color(c)), fan = new THREE.Color(frame.fan);  // as in the pictures
const plain = new THREE.Color("#9fb0c0"), chosen = new THREE.Color("#d9730d");

function solid() {
  return new THREE.MeshLambertMaterial({ vertexColors: true, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
}
function withEdges(geometry) {
  const group = new THREE.Group();
  group.add(new THREE.Mesh(geometry, solid()),
    new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({ color: 0x101820, wireframe: true })));
  return group;
}

// The view itself: canvas, camera, light; one object at a time.
class Stage {
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(40, 1, 0.01, 100);
    this.controls = new OrbitControls(this.camera, canvas);
    const lamp = new THREE.DirectionalLight(0xffffff, 2.4);
    lamp.position.set(-0.4, 0.6, 1);
    this.camera.add(lamp);
    this.scene.add(this.camera, new THREE.AmbientLight(0xffffff, 0.7));
    this.controls.addEventListener("change", () => this.draw());
    canvas.addEventListener("keydown", (event) => this.key(event));
    addEventListener("resize", () => this.draw());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
  }
  key(event) {
    const offset = new THREE.Spherical().setFromVector3(this.camera.position.clone().sub(this.controls.target)), step = Math.PI / 18;
    const moves = {
      ArrowLeft: () => (offset.theta -= step), ArrowRight: () => (offset.theta += step),
      ArrowUp: () => (offset.phi -= step), ArrowDown: () => (offset.phi += step),
      "+": () => (offset.radius /= 1.2), "=": () => (offset.radius /= 1.2), "-": () => (offset.radius *= 1.2),
    };
    if (!moves[event.key] || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    moves[event.key]();
    offset.makeSafe();
    this.camera.position.setFromSpherical(offset).add(this.controls.target);
    this.controls.update();
    this.draw();
  }
  show(object) {
    if (this.object) this.scene.remove(this.object);
    this.scene.add((this.object = object));
  }
  look(target, eye, size) {
    this.camera.near = size / 1000;
    this.camera.far = size * 100;
    this.controls.target.copy(target);
    // On a narrow screen further away, so that nothing is cut off at the sides.
    const narrow = Math.max(1, (1.15 * this.canvas.clientHeight) / this.canvas.clientWidth);
    this.camera.position.copy(target).addScaledVector(eye.clone().sub(target), narrow);
    this.controls.update();
  }
  draw() {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.renderer.setClearColor(matchMedia("(prefers-color-scheme: dark)").matches ? 0x1b1f23 : 0xf2f4f6);
    this.renderer.render(this.scene, this.camera);
  }
}

// A tessellation, triangle by triangle: by the combined strategy, or what a subject delivered.
class Tessellation {
  constructor(model) {
    this.model = model;
    this.positions = points(model.positions);
    this.depth = new Uint8Array(bytes(model.depth)), this.kind = new Uint8Array(bytes(model.kind));
    this.geometry = new THREE.BufferGeometry();
    this.geometry.setAttribute("position", new THREE.BufferAttribute(this.positions, 3));
    this.geometry.setAttribute("normal", new THREE.BufferAttribute(new Int8Array(bytes(model.normals)), 3, true));
    this.colour = new THREE.BufferAttribute(new Float32Array(this.positions.length), 3);
    this.geometry.setAttribute("color", this.colour);
    this.errors = { position: new Uint8Array(bytes(model.position_error)), normal: new Uint8Array(bytes(model.normal_error)) };
    this.object = withEdges(this.geometry);
    this.geometry.computeBoundingSphere();
  }
  paint(by) {
    const { model, errors, kind, depth } = this;
    const logarithmic = (name) => (t) => ramp(errors[name][t] / 255);
    const of = {
      depth: (t) => (kind[t] === 2 ? fan : depths[depth[t]]), kind: (t) => kinds[kind[t]],
      position: logarithmic("position"), normal: logarithmic("normal"),
    }[by];
    for (let t = 0; t < depth.length; ++t) {
      const c = of(t);
      for (let k = 0; k < 3; ++k) this.colour.setXYZ(3 * t + k, c.r, c.g, c.b);
    }
    this.colour.needsUpdate = true;
    return {
      depth: "as in the pictures: light is shallow, dark is deep, fans are orange",
      kind: "blue: pairs, red: without partner, orange: fans",
      position: `logarithmic; yellow: ${model.worst_position.toPrecision(2)} of the diagonal, violet: 10⁻⁴ of that`,
      normal: `logarithmic; yellow: ${model.worst_normal.toPrecision(2)} degrees, violet: 10⁻⁴ of that`,
    }[by];
  }
  // Of the triangle that is worst by what is shown: middle, normal, and an outline that no other triangle hides.
  worst(by) {
    const t = by === "normal" ? this.model.worst_normal_at : this.model.worst_position_at;
    const corners = [0, 1, 2].map((k) => new THREE.Vector3().fromArray(this.positions, 9 * t + 3 * k));
    const middle = corners.reduce((sum, c) => sum.add(c), new THREE.Vector3()).divideScalar(3);
    const ink = { color: 0xff2010, depthTest: false, transparent: true };
    const outline = new THREE.LineLoop(new THREE.BufferGeometry().setFromPoints(corners), new THREE.LineBasicMaterial(ink));
    const ball = new THREE.Mesh(new THREE.SphereGeometry(this.geometry.boundingSphere.radius / 150, 16, 12), new THREE.MeshBasicMaterial(ink));
    ball.position.copy(middle);
    outline.renderOrder = ball.renderOrder = 1;
    const mark = new THREE.Group().add(outline, ball);
    return { middle, normal: new THREE.Vector3().fromBufferAttribute(this.geometry.getAttribute("normal"), 3 * t), mark };
  }
}

// The surface of a witness's mesh with its control face and point marked.
function marked(shape, witness) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(points(shape.positions), 3));
  geometry.setIndex(new THREE.BufferAttribute(new Uint16Array(bytes(shape.triangles)), 1));
  const apart = geometry.toNonIndexed(), face = new Int32Array(bytes(shape.face));
  geometry.computeVertexNormals();
  apart.setAttribute("normal", geometry.toNonIndexed().getAttribute("normal"));
  const colour = new Float32Array(9 * face.length);
  for (let t = 0; t < face.length; ++t)
    for (let k = 0; k < 3; ++k) (face[t] === witness.face ? chosen : plain).toArray(colour, 9 * t + 3 * k);
  apart.setAttribute("color", new THREE.BufferAttribute(colour, 3));
  apart.computeBoundingBox();
  const size = apart.boundingBox.getSize(new THREE.Vector3()).length();

  const point = new THREE.Vector3(...witness.position), normal = new THREE.Vector3(...witness.normal);
  const object = withEdges(apart);
  const pin = (at, along, colour, length) => {
    const ink = new THREE.MeshBasicMaterial({ color: colour, depthTest: false, transparent: true });
    const ball = new THREE.Mesh(new THREE.SphereGeometry(size / 200, 16, 12), ink);
    ball.position.copy(at);
    const needle = new THREE.Mesh(new THREE.CylinderGeometry(size / 800, size / 800, length), ink);
    needle.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), along.clone().normalize());
    needle.position.copy(at).addScaledVector(along.clone().normalize(), length / 2);
    ball.renderOrder = needle.renderOrder = 1;
    object.add(ball, needle);
  };
  // What the subject delivered first, and longer: where both agree its end still shows.
  const finite = (v) => v && v.every(Number.isFinite);
  if (finite(witness.got_position)) pin(new THREE.Vector3(...witness.got_position), normal, 0xc0341d, size / 8);
  if (finite(witness.got_normal)) pin(point, new THREE.Vector3(...witness.got_normal), 0xc0341d, size / 8);
  pin(point, normal, 0x000000, size / 12);
  // Seen from before the surface, a little from the side so that the needle shows.
  const side = Math.abs(normal.y) < 0.9 ? new THREE.Vector3(0, 1, 0) : new THREE.Vector3(1, 0, 0);
  side.cross(normal).normalize();
  return { object, point, eye: point.clone().addScaledVector(normal, 0.7 * size).addScaledVector(side, 0.5 * size), size };
}

async function start(element) {
  const control = (name) => element.querySelector(name);
  const select = control("select[name=colour]"), surface = control("select[name=surface]"), wire = control("input[name=wire]"), legend = control("output"), back = control("button[name=back]");
  const bar = control(".ramp"), toTable = control("button[name=table]");
  const stage = new Stage(control("canvas")), shapes = await unpacked("shapes");
  const models = [await unpacked("model"), ...(document.getElementById("maps") ? await unpacked("maps") : [])], made = [];
  const current = () => (made[surface.value] ??= new Tessellation(models[surface.value]));
  let witness = null, from = null, mark = null;

  function unmark() {
    mark?.removeFromParent();
    mark = null;
  }
  function refresh() {
    bar.hidden = Boolean(witness) || !["position", "normal"].includes(select.value);
    if (!witness) legend.textContent = current().paint(select.value);
    stage.object.children[1].visible = wire.checked;
    stage.draw();
  }
  function overview() {
    unmark();
    witness = null;
    back.hidden = toTable.hidden = true;
    const { center, radius } = current().geometry.boundingSphere;
    stage.show(current().object);
    stage.look(center, new THREE.Vector3(1.3, 1.4, 3.6).multiplyScalar(radius / 1.4).add(center), 2 * radius);
    refresh();
  }
  function jump(to, button) {
    from = button;
    const scene = marked(shapes[to.mesh], to);
    witness = to;
    back.hidden = toTable.hidden = false;
    stage.show(scene.object);
    stage.look(scene.point, scene.eye, scene.size);
    legend.textContent = to.text;
    refresh();
    element.scrollIntoView({ block: "start" });
    stage.canvas.focus({ preventScroll: true });
  }
  select.addEventListener("change", () => (witness ? overview() : refresh()));
  surface.addEventListener("change", () => {
    if (surface.value > 0 && !["position", "normal"].includes(select.value)) select.value = "position";
    wire.checked = current().depth.length < 4000;  // more edges would hide the colours
    overview();
  });
  wire.addEventListener("change", refresh);
  back.addEventListener("click", overview);
  toTable.addEventListener("click", () => {
    from.scrollIntoView({ block: "center" });
    from.focus({ preventScroll: true });
  });
  control("button[name=worst]").addEventListener("click", () => {
    if (witness) overview();
    unmark();
    const { middle, normal, mark: outline } = current().worst(select.value), { radius } = current().geometry.boundingSphere;
    stage.object.add((mark = outline));
    stage.look(middle, middle.clone().addScaledVector(normal, 0.4 * radius), 2 * radius);
    stage.draw();
  });
  overview();
  return jump;
}

// Nothing is drawn before it can be seen or is asked for.
const element = document.getElementById("viewer");
let ready = null;
function begin() {
  ready ??= start(element).catch((error) => {
    element.querySelector("output").textContent = `This browser shows no WebGL (${error.message}).`;
  });
  return ready;
}
new IntersectionObserver((entries, observer) => {
  if (!entries.some((entry) => entry.isIntersecting)) return;
  observer.disconnect();
  begin();
}).observe(element);
document.addEventListener("click", async (event) => {
  const button = event.target.closest?.("button.jump");
  if (button) (await begin())?.(JSON.parse(button.dataset.witness), button);
});
