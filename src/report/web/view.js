// Where the scene is looked at from: freely, from above, or with the camera of the run.
const view = { mode: "orbit", flight: 0 };

function lookAt(target, distance, direction) {
  world.controls.target.copy(target);
  world.camera.position.copy(target).addScaledVector(direction.normalize(), distance);
  world.camera.up.set(0, 1, 0);
  world.controls.update();
  draw();
}

// The corrected trajectory, with its longer side across the screen.
function showAll() {
  const box = new THREE.Box3();
  for (let i = 0; i < rowCount(); ++i) box.expandByPoint(point(run.corrected, i));
  const centre = box.getCenter(new THREE.Vector3()), size = box.getSize(new THREE.Vector3());
  const wide = world.camera.aspect > 1, turned = wide === size.z > size.x;
  const [across, deep] = turned ? [size.z, size.x] : [size.x, size.z];
  const half = Math.tan((world.camera.fov * Math.PI) / 360), steepness = view.mode === "above" ? 1 : 0.8;
  const distance = Math.max(across / 2 / half / world.camera.aspect, (deep * steepness) / 2 / half, 15) * 1.15;
  const away = Math.sqrt(1 - steepness * steepness) || 1e-4; // towards the viewer
  const direction = turned ? new THREE.Vector3(away, steepness, 0) : new THREE.Vector3(0, steepness, away);
  lookAt(centre, distance + (away * deep) / 2, direction);
}

function follow() {
  const turn = run.turns, q = new THREE.Quaternion(turn[4 * row], turn[4 * row + 1], turn[4 * row + 2], turn[4 * row + 3]);
  world.camera.position.copy(poseAt(row));
  world.camera.quaternion.copy(q.normalize());
  draw();
}

function setView(mode) {
  view.mode = mode;
  ++view.flight;
  for (const button of $("views").children)
    button.setAttribute("aria-pressed", button.dataset.view === mode ? "true" : "false");
  world.controls.enabled = mode !== "driver";
  world.controls.enableRotate = mode === "orbit";
  world.controls.minPolarAngle = 0;
  world.controls.maxPolarAngle = mode === "orbit" ? Math.PI * 0.495 : Math.PI;
  // from above, a drag moves the map
  world.controls.mouseButtons.LEFT = mode === "above" ? THREE.MOUSE.PAN : THREE.MOUSE.ROTATE;
  world.controls.touches.ONE = mode === "above" ? THREE.TOUCH.PAN : THREE.TOUCH.ROTATE;
  if (mode !== "orbit" && world.spread) spreadPasses(false);
  makeRoom();
  mode === "driver" ? follow() : showAll();
}

// Moves to a target within half a second.
function flyTo(target, distance) {
  if (view.mode === "driver") return setRow(rowOf(chosen.query));
  const flight = ++view.flight, start = performance.now();
  const from = world.controls.target.clone(), away = world.camera.position.clone().sub(from);
  const length = away.length(), direction = away.normalize();
  const reduced = matchMedia("(prefers-reduced-motion: reduce)").matches;
  const step = (now) => {
    if (flight !== view.flight) return;
    const share = reduced ? 1 : Math.min(1, Math.max(0, now - start) / 500), smooth = share * share * (3 - 2 * share);
    const between = from.clone().lerp(target, smooth);
    lookAt(between, length * Math.pow(distance / length, smooth), direction.clone());
    if (share < 1) requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}
