/* Runs the interactive view of a report in Node.js with its own three.js, without drawing, and prints for each load step what it would draw:
   centre of each body, largest angle between its normals and those of its moved triangles, boxes of contact surfaces, largest coordinate on
   the canvas (1: its edge).

     node view_without_browser.js report.html */
"use strict";
const fs = require("fs");
const vm = require("vm");

const page = fs.readFileSync(process.argv[2], "utf8");
const data = page.match(/id="view3d_data">([\s\S]*?)<\/script>/)[1];
const [library, view] = [...page.matchAll(/<script>\/\/<!\[CDATA\[\n([\s\S]*?)\n\/\/\]\]><\/script>/g)].map(found => found[1]);

/* As much of a page as the view touches. */
const elements = {};
const pen = new Proxy({}, { get: () => () => ({}), set: () => true });
const element = name => elements[name] = elements[name] || {
  style: {}, dataset: {}, classList: { add() {}, remove() {} }, clientWidth: 600, clientHeight: 400, width: 512, height: 8, value: "",
  textContent: name === "view3d_data" ? data : "", addEventListener() {}, getContext: () => pen, querySelector: element, querySelectorAll: () => []
};
const world = { console, atob: text => Buffer.from(text, "base64").toString("latin1"), requestAnimationFrame() {}, navigator: { userAgent: "" },
  document: { getElementById: element, createElement: element, createElementNS: (_, name) => element(name), addEventListener() {} },
  addEventListener() {}, devicePixelRatio: 1 };
world.window = world.self = world;
vm.createContext(world);
vm.runInContext(library, world);
world.THREE.WebGLRenderer = function () {
  return { setClearColor() {}, setPixelRatio() {}, setSize() {}, clear() {}, clearDepth() {}, render() {}, setRenderTarget() {} };
};
vm.runInContext(view, world);
const shown = world.sutureView;
if (!shown) throw new Error(element(".failed").textContent);

const minus = (a, b) => a.map((part, k) => part - b[k]);
const cross = (a, b) => [0, 1, 2].map(k => a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3]);
const unit = a => a.map(part => part / Math.hypot(...a));

function rows(corners) {
  const place = corners.array("position"), shift = corners.array("shift"), found = [];
  for (let i = 0; i < place.length; i += 3) found.push([0, 1, 2].map(k => place[i + k] + shown.enlargement * shift[i + k]));
  return found;
}

function body(part) {
  const places = rows(part.corners), normals = part.corners.array("normal");
  let off = 0, edge = 0;
  for (let i = 0; i < places.length; i += 3) {
    const normal = unit(cross(minus(places[i + 1], places[i]), minus(places[i + 2], places[i])));
    off = Math.max(off, Math.hypot(...minus(normal, Array.from(normals.slice(3 * i, 3 * i + 3)))));
  }
  for (const place of places) {
    const on = new world.THREE.Vector3(...place).project(shown.camera);
    edge = Math.max(edge, Math.abs(on.x), Math.abs(on.y), Math.abs(on.z));
  }
  return { name: part.name, centre: [0, 1, 2].map(k => places.reduce((sum, place) => sum + place[k], 0) / places.length), normals: off, edge };
}

function contact(part) {
  const places = rows(part.corners);
  return { name: part.name, drawn: part.mesh.geometry === part.corners.geometry, count: places.length,
    low: [0, 1, 2].map(k => Math.min(...places.map(place => place[k]))), high: [0, 1, 2].map(k => Math.max(...places.map(place => place[k]))) };
}

console.log(JSON.stringify(shown.data.frames.map((name, frame) => {
  shown.setFrame(frame);
  return { bodies: shown.parts.map(body), contacts: shown.faces.map(contact) };
})));
