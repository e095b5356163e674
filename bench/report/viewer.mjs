// SPDX-License-Identifier: MIT
// The report's view in three dimensions: orbit with the mouse, a finger or the arrow keys; colours by what is chosen.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const floats = (text) => new Float32Array(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);

// Dark to light, readable without colour vision (viridis).
const stops = ["#440154", "#3b528b", "#21918c", "#5ec962", "#fde725"].map((c) => new THREE.Color(c));
function ramp(t) {
  const x = Math.min(Math.max(t, 0), 1) * (stops.length - 1), k = Math.min(Math.floor(x), stops.length - 2);
  return stops[k].clone().lerp(stops[k + 1], x - k);
}
const kinds = ["#21618c", "#c0392b", "#d9730d", "#7d3c98"].map((c) => new THREE.Color(c));

function start(model, element) {
  const canvas = element.querySelector("canvas"), select = element.querySelector("select");
  const wire = element.querySelector("input[name=wire]"), legend = element.querySelector("output");
  const renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
  const scene = new THREE.Scene(), camera = new THREE.PerspectiveCamera(40, 1, 0.01, 100);
  camera.position.set(1.3, 1.4, 3.6);
  const controls = new OrbitControls(camera, canvas);
  controls.listenToKeyEvents(canvas);
  const lamp = new THREE.DirectionalLight(0xffffff, 2.4);
  camera.add(lamp);
  lamp.position.set(-0.4, 0.6, 1);
  scene.add(camera, new THREE.AmbientLight(0xffffff, 0.7));

  const positions = floats(model.positions), geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  geometry.setAttribute("normal", new THREE.BufferAttribute(floats(model.normals), 3));
  const colour = new THREE.BufferAttribute(new Float32Array(positions.length), 3);
  geometry.setAttribute("color", colour);
  const material = new THREE.MeshLambertMaterial({ vertexColors: true, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
  const lines = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({ color: 0x101820, wireframe: true }));
  scene.add(new THREE.Mesh(geometry, material), lines);

  const errors = { position: floats(model.position_error), normal: floats(model.normal_error) };
  const paint = {
    depth: (t) => ramp(model.depth[t] / 5),
    kind: (t) => kinds[model.kind[t]],
    position: (t) => ramp(1 + Math.log10(Math.max(errors.position[t], 1e-9) / model.worst_position) / 4),
    normal: (t) => ramp(1 + Math.log10(Math.max(errors.normal[t], 1e-9) / model.worst_normal) / 4),
  };
  const words = {
    depth: "dark: depth 0, light: depth 5",
    kind: "blue: pairs, red: without partner, orange: fans",
    position: `logarithmic; yellow: ${model.worst_position.toPrecision(2)} of the diagonal, violet: 10⁻⁴ of that`,
    normal: `logarithmic; yellow: ${model.worst_normal.toPrecision(2)} degrees, violet: 10⁻⁴ of that`,
  };

  function draw() {
    const width = canvas.clientWidth, height = canvas.clientHeight;
    renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    const dark = matchMedia("(prefers-color-scheme: dark)").matches;
    renderer.setClearColor(dark ? 0x1b1f23 : 0xf2f4f6);
    renderer.render(scene, camera);
  }
  function recolour() {
    for (let t = 0; t < model.depth.length; ++t) {
      const c = paint[select.value](t);
      for (let k = 0; k < 3; ++k) colour.setXYZ(3 * t + k, c.r, c.g, c.b);
    }
    colour.needsUpdate = true;
    lines.visible = wire.checked;
    legend.textContent = words[select.value];
    draw();
  }
  // The witness: the triangle that is worst by what is shown.
  function jump() {
    const by = select.value === "normal" ? errors.normal : errors.position;
    const t = by.indexOf(Math.max(...by)), middle = new THREE.Vector3();
    for (let k = 0; k < 3; ++k) middle.add(new THREE.Vector3().fromArray(positions, 9 * t + 3 * k));
    middle.divideScalar(3);
    const normal = new THREE.Vector3().fromBufferAttribute(geometry.getAttribute("normal"), 3 * t);
    controls.target.copy(middle);
    camera.position.copy(middle).addScaledVector(normal, 0.6);
    controls.update();
    draw();
  }
  controls.addEventListener("change", draw);
  select.addEventListener("change", recolour);
  wire.addEventListener("change", recolour);
  element.querySelector("button").addEventListener("click", jump);
  addEventListener("resize", draw);
  recolour();
}

const element = document.getElementById("viewer");
try {
  start(JSON.parse(document.getElementById("model").textContent), element);
} catch (error) {
  element.querySelector("output").textContent = `This browser shows no WebGL (${error.message}).`;
}
