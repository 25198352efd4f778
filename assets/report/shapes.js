"use strict";
// Mode shapes moving on the machine's own geometry.

const PART_COLOURS = [0xb0bac6, 0x8f9db3, 0xe3dcc4, 0x8d97a5, 0xd8a13c];
const BODY = 2;
/** Largest displacement in the picture over the machine's length; largest rotation [rad]. */
const SHOWN_DISPLACEMENT = 0.08;
const SHOWN_ROTATION = 0.35;

/** Viewer of the shapes of `campbell/shapes` (branch, speed, node, 6) or `modes/shapes` (speed, mode, node, 6). */
function shapeViewer(results, machine) {
  const overSpeed = results.set("campbell/shapes");
  const stored = results.set("modes/shapes");
  if (!machine || (!overSpeed && !stored)) return null;
  const canvas = make("canvas", { tabindex: 0, role: "img", "aria-label": "Mode shape in motion; arrow keys turn the view, + and − zoom" });
  const holder = make("div", { class: "viewer" }, canvas);
  const says = make("p", { class: "says", "aria-live": "polite" });
  let scene;
  try {
    scene = machineScene(canvas, machine);
  } catch (error) {
    holder.replaceChildren(make("p", {}, `This browser cannot show moving shapes (WebGL: ${error.message}). The drawn shapes are among the figures below.`));
  }
  const show = (shape, words) => {
    const isComputed = shape.every(Number.isFinite);
    scene?.set(isComputed ? shape : new Float64Array(shape.length));
    says.textContent = isComputed ? words : `${words}; its shape was not computed`;
  };
  const size = (set) => set.shape[2] * 12;
  const showBranch = (branch, speed) => {
    if (!overSpeed) return;
    const from = (branch * overSpeed.shape[1] + speed) * size(overSpeed);
    const rpm = results.values("campbell/rpm")[speed];
    const frequency = results.values("campbell/frequency")[branch * overSpeed.shape[1] + speed];
    const label = results.values("campbell/label")[branch];
    show(overSpeed.values.slice(from, from + size(overSpeed)), `${label} at ${digits(rpm)} rpm: ${digits(frequency)} Hz`);
  };
  const controls = make("div", { class: "controls" });
  const pause = make("button", { type: "button", "aria-pressed": "false", onclick: () => {
    const still = scene?.toggle();
    pause.setAttribute("aria-pressed", String(still));
    pause.textContent = still ? "Move" : "Pause";
  } }, "Pause");
  controls.append(pause);
  if (!overSpeed) {
    const rpm = results.values("modes/rpm");
    const state = { speed: 0, mode: 0 };
    const modes = stored.shape[1];
    const labels = results.values("modes/label");
    const showStored = () => {
      const k = state.speed * modes + state.mode;
      show(stored.values.slice(k * size(stored), (k + 1) * size(stored)), `${labels[k]} at ${digits(rpm[state.speed])} rpm: ${digits(results.values("modes/frequency")[k])} Hz`);
    };
    controls.append(
      select("Speed", Array.from(rpm, (v) => `${digits(v)} rpm`), 0, (k) => { state.speed = k; showStored(); }),
      select("Mode", Array.from({ length: modes }, (_, m) => `${m + 1}: ${labels[m]}`), 0, (k) => { state.mode = k; showStored(); }),
    );
    showStored();
  } else showBranch(0, overSpeed.shape[1] - 1);
  const node = make("figure", { class: "chart" }, controls, holder, says, make("figcaption", {}, "Mode shape on the machine's geometry, enlarged and slowed down; the rotor is drawn without its spin. Closed lines are the orbits of shaft points at discs and bearings. Drag, scroll or use the arrow keys to turn the view."));
  return { node, showBranch, moved: () => scene?.moved() };
}

/** Corners of the triangles of a part, and of all others. */
function trianglesOf(machine, part) {
  const lists = [[], []];
  for (let k = 0; k < machine.triangles.length; k += 3) {
    const corners = machine.triangles.slice(k, k + 3);
    lists[machine.parts[corners[0]] === part ? 0 : 1].push(...corners);
  }
  return lists;
}

/** Scene of the machine: set(shape) shows a shape, complex displacement and rotation of every node. */
function machineScene(canvas, machine) {
  const renderer = new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
  const scene = new THREE.Scene();
  const camera = new THREE.PerspectiveCamera(35, 2, 0.001, 100);
  scene.add(new THREE.HemisphereLight(0xffffff, 0x8d8d99, 2.2));
  const sun = new THREE.DirectionalLight(0xffffff, 1.6);
  sun.position.set(-1, 2, -0.5);
  scene.add(sun);

  const rest = machine.points;
  const position = new THREE.BufferAttribute(new Float32Array(rest), 3);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", position);
  geometry.setAttribute("color", new THREE.BufferAttribute(sectorColours(machine), 3));
  // Bodies are translucent, so that the bearings in them are seen.
  const solid = geometry;
  const bodies = geometry.clone();
  bodies.setAttribute("position", position);
  const [inBodies, others] = trianglesOf(machine, BODY);
  solid.setIndex(others);
  bodies.setIndex(inBodies);
  const look = { vertexColors: true, side: THREE.DoubleSide, flatShading: true };
  scene.add(new THREE.Mesh(solid, new THREE.MeshLambertMaterial(look)));
  scene.add(new THREE.Mesh(bodies, new THREE.MeshLambertMaterial({ ...look, transparent: true, opacity: 0.35, depthWrite: false })));

  const box = extent(rest);
  const length = Math.max(...[0, 1, 2].map((i) => box.high[i] - box.low[i]));
  const middle = new THREE.Vector3(...[0, 1, 2].map((i) => 0.5 * (box.low[i] + box.high[i])));
  camera.near = length / 100;
  camera.far = length * 30;
  camera.position.copy(middle).add(new THREE.Vector3(-1.2, 0.5, -0.45).multiplyScalar(length));
  const turn = new THREE.OrbitControls(camera, canvas);
  turn.target.copy(middle);
  turn.update();
  keyboard(canvas, camera, turn);

  const orbits = machine.orbit_nodes.map(() => {
    const line = new THREE.LineLoop(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ depthTest: false }));
    line.renderOrder = 1;
    scene.add(line);
    return line;
  });
  let shape = null;
  let scale = 0;
  let still = matchMedia("(prefers-reduced-motion: reduce)").matches;
  let phase = 0;
  let last = 0;
  let frames = 0;

  const place = () => {
    const [cos, sin] = [Math.cos(phase) * scale, Math.sin(phase) * scale];
    const out = position.array;
    const { carriers } = machine;
    out.set(rest);
    for (let c = 0; c < carriers.point.length; c++) {
      const p = 3 * carriers.point[c];
      const from = 12 * carriers.node[c];
      const w = carriers.weight[c];
      const value = (d) => w * (shape[from + 2 * d] * cos - shape[from + 2 * d + 1] * sin);
      const [ax, ay, az] = [carriers.arm[3 * c], carriers.arm[3 * c + 1], carriers.arm[3 * c + 2]];
      const [rx, ry, rz] = [value(3), value(4), value(5)];
      out[p] += value(0) + ry * az - rz * ay;
      out[p + 1] += value(1) + rz * ax - rx * az;
      out[p + 2] += value(2) + rx * ay - ry * ax;
    }
    position.needsUpdate = true;
  };
  const size = () => {
    const [w, h] = [canvas.clientWidth, canvas.clientHeight];
    if (canvas.width !== Math.round(w * devicePixelRatio) || canvas.height !== Math.round(h * devicePixelRatio)) {
      renderer.setPixelRatio(devicePixelRatio);
      renderer.setSize(w, h, false);
      camera.aspect = w / Math.max(h, 1);
      camera.updateProjectionMatrix();
    }
  };
  const paint = (now) => {
    const step = Math.min(now - last, 100) / 1000;
    last = now;
    if (shape && canvas.checkVisibility?.() !== false) {
      if (!still) phase = (phase + step * Math.PI) % (2 * Math.PI);
      place();
      size();
      renderer.render(scene, camera);
      frames += 1;
    }
    requestAnimationFrame(paint);
  };
  const theme = () => {
    scene.background = new THREE.Color(colours().paper);
    orbits.forEach((line) => line.material.color.set(colours().red));
  };
  document.addEventListener("themechange", theme);
  theme();
  requestAnimationFrame(paint);
  return {
    set(next) {
      shape = next;
      scale = pictureScale(shape, length);
      machine.orbit_nodes.forEach((node, k) => {
        const points = [];
        for (let i = 0; i < 48; i++) {
          const [cos, sin] = [Math.cos((i * Math.PI) / 24) * scale, Math.sin((i * Math.PI) / 24) * scale];
          const at = (d) => shape[12 * node + 2 * d] * cos - shape[12 * node + 2 * d + 1] * sin;
          points.push(new THREE.Vector3(at(0), at(1), machine.node_z[node] + at(2)));
        }
        orbits[k].geometry.setFromPoints(points);
      });
    },
    toggle() {
      still = !still;
      return still;
    },
    moved: () => ({ frames, phase, position: Array.from(position.array.slice(0, 30)) }),
  };
}

/** Scale of a shape so that its largest displacement or rotation has the size of the picture's. */
function pictureScale(shape, length) {
  let displacement = 0;
  let rotation = 0;
  for (let k = 0; k < shape.length; k += 12) {
    for (let d = 0; d < 6; d++) {
      const size = Math.hypot(shape[k + 2 * d], shape[k + 2 * d + 1]);
      if (d < 3) displacement = Math.max(displacement, size);
      else rotation = Math.max(rotation, size);
    }
  }
  const scales = [displacement > 0 ? (SHOWN_DISPLACEMENT * length) / displacement : Infinity, rotation > 0 ? SHOWN_ROTATION / rotation : Infinity];
  const scale = Math.min(...scales);
  return Number.isFinite(scale) ? scale : 0;
}

/** Colours by part; shaft and discs in alternating sectors, so that a rotation is seen. */
function sectorColours(machine) {
  const count = machine.points.length / 3;
  const out = new Float32Array(3 * count);
  const colour = new THREE.Color();
  for (let p = 0; p < count; p++) {
    const part = machine.parts[p];
    colour.set(PART_COLOURS[part]);
    if (part < 2) {
      const angle = Math.atan2(machine.points[3 * p + 1], machine.points[3 * p]) / (Math.PI / 4);
      if (Math.floor(angle + 8.001) % 2 === 0) colour.multiplyScalar(0.72);
    }
    out.set([colour.r, colour.g, colour.b], 3 * p);
  }
  return out;
}

function extent(points) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let k = 0; k < points.length; k++) {
    low[k % 3] = Math.min(low[k % 3], points[k]);
    high[k % 3] = Math.max(high[k % 3], points[k]);
  }
  return { low, high };
}

/** Arrow keys turn the view, + and − zoom. */
function keyboard(canvas, camera, turn) {
  const moves = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] };
  canvas.addEventListener("keydown", (event) => {
    const arm = camera.position.clone().sub(turn.target);
    if (moves[event.key]) {
      const [around, over] = moves[event.key];
      const flat = Math.hypot(arm.x, arm.z);
      const azimuth = Math.atan2(arm.x, arm.z) + around;
      const height = Math.max(-1.5, Math.min(1.5, Math.atan2(arm.y, flat) - over));
      const r = arm.length();
      arm.set(r * Math.cos(height) * Math.sin(azimuth), r * Math.sin(height), r * Math.cos(height) * Math.cos(azimuth));
    } else if (event.key === "+" || event.key === "-") arm.multiplyScalar(event.key === "+" ? 0.9 : 1.1);
    else return;
    event.preventDefault();
    camera.position.copy(turn.target).add(arm);
    turn.update();
  });
}
