// The time slider: everything as far as the run had come.
const paths = {};
const pathGroup = new THREE.Group();
let playing = false;
let cursor = null;

function makePaths() {
  clearGroup(pathGroup);
  paths.odometry = pathMesh(run.odometry, odometryColour());
  paths.corrected = pathMesh(run.corrected, correctedColour());
  paths.truth = run.truth ? pathMesh(run.truth, truthColour()) : null;
  for (const mesh of Object.values(paths)) if (mesh) pathGroup.add(mesh);
  cursor = new THREE.Mesh(new THREE.ConeBufferGeometry(0.9, 3, 16).rotateX(-Math.PI / 2), new THREE.MeshBasicMaterial({ color: odometryColour() }));
  pathGroup.add(cursor);
}

function showLayers() {
  for (const [name, mesh] of Object.entries(paths)) if (mesh) mesh.visible = !hidden.has(name);
  objectGroup.visible = !hidden.has("objects");
  loopGroup.visible = !hidden.has("loops") && !chosen;
  refusedGroup.visible = !hidden.has("refused") && !chosen;
  if (cursor) cursor.visible = view.mode !== "driver";
  draw();
}

function setRow(to) {
  row = Math.max(0, Math.min(rowCount() - 1, to));
  $("time").value = row;
  $("clock").textContent = `${run.stamps[row].toFixed(1)} s, frame ${row * run.stride}`;
  if (!world.renderer) return;
  for (const mesh of Object.values(paths)) if (mesh) showPathUntil(mesh, row);
  showObjectsUntil((row + 1) * run.stride - 1);
  showLoopsUntil(row);
  cursor.position.copy(poseAt(row));
  cursor.quaternion.set(...run.turns.slice(4 * row, 4 * row + 4)).normalize();
  cursor.visible = view.mode !== "driver";
  cursor.scale.setScalar(Math.max(1, world.extent / 250));
  if (view.mode === "driver") follow();
  draw();
}

function play(on) {
  playing = on;
  $("play").textContent = on ? "❚❚" : "▶";
  if (!on) return;
  if (row >= rowCount() - 1) setRow(0);
  const start = performance.now(), first = row, rate = Math.max(10, rowCount() / 30); // rows per second
  const step = (now) => {
    if (!playing) return;
    setRow(first + Math.floor((Math.max(0, now - start) / 1000) * rate));
    row >= rowCount() - 1 ? play(false) : requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}
