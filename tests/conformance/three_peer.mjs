// three.js's side of formats/three.py: node three_peer.mjs HOME ASKED.json ANSWER.json
// HOME is the folder that has node_modules.
import fs from "fs";
import { createRequire } from "module";
import path from "path";

const [home, asked, answer] = process.argv.slice(2);
const THREE = createRequire(path.join(home, "peer.js"))("three");

// mulberry32: the same numbers on every day.
function randomNumbers(seed) {
  let state = seed | 0;
  return (low, high) => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return low + ((high - low) * ((t ^ (t >>> 14)) >>> 0)) / 4294967296;
  };
}

// Pixels from the left upper corner, of an image of that size.
function pixels(camera, points, [width, height]) {
  return points.map((point) => {
    const seen = new THREE.Vector3(...point).project(camera);
    return [((seen.x + 1) / 2) * width, ((1 - seen.y) / 2) * height];
  });
}

function readCamera({ file, size, points }) {
  const camera = new THREE.ObjectLoader().parse(file);
  camera.updateProjectionMatrix();
  camera.updateMatrixWorld(true);
  const view = camera.view;
  if (view.width !== size[0] || view.height !== size[1]) throw new Error("another size");
  return pixels(camera, points, size);
}

function place(object, random) {
  object.position.set(random(-3, 3), random(-3, 3), random(-3, 3));
  object.rotation.set(random(-3, 3), random(-3, 3), random(-3, 3));
}

// A camera of three.js's own, below a group that is moved, turned and scaled.
function makeCamera(number, random) {
  const scene = new THREE.Scene();
  const group = new THREE.Group();
  place(group, random);
  group.scale.setScalar(random(0.3, 3));
  const size = [Math.floor(random(16, 3000)), Math.floor(random(16, 3000))];
  let camera;
  if (number % 2) {
    camera = new THREE.PerspectiveCamera(random(5, 140), random(0.3, 3), 0.1, 1000);
    camera.filmOffset = random(-10, 10);
    camera.filmGauge = random(10, 60);
  } else {
    const [left, right] = [-random(0.1, 3), random(0.1, 3)];
    const [top, bottom] = [random(0.1, 3), -random(0.1, 3)];
    camera = new THREE.OrthographicCamera(left, right, top, bottom, random(-5, 2), 100);
  }
  camera.zoom = random(0.3, 3);
  const offAxis = number % 3 !== 0;
  if (offAxis) {
    const full = [random(0.5, 3) * size[0], random(0.5, 3) * size[1]];
    const offset = [random(-0.5, 1) * size[0], random(-0.5, 1) * size[1]];
    camera.setViewOffset(...full, ...offset, ...size);
  }
  place(camera, random);
  if (number % 5 === 0) camera.scale.setScalar(2);
  group.add(camera);
  scene.add(group);
  scene.updateMatrixWorld(true);
  camera.updateProjectionMatrix();
  const points = [];
  for (let k = 0; k < 8; k++) {
    const cube = [random(-0.98, 0.98), random(-0.98, 0.98), random(-0.5, 0.95)];
    points.push(new THREE.Vector3(...cube).unproject(camera).toArray());
  }
  const seen = pixels(camera, points, size);
  return { file: scene.toJSON(), size, has_size: offAxis, points, pixels: seen };
}

function answered(question) {
  if (question.do === "read") return question.cameras.map(readCamera);
  const random = randomNumbers(question.seed);
  return Array.from({ length: question.count }, (_, number) => makeCamera(number, random));
}

const question = JSON.parse(fs.readFileSync(asked, "utf8"));
fs.writeFileSync(answer, JSON.stringify(answered(question)));
