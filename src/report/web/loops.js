// Edges between the cameras of a loop, and the loop that was chosen.
const loopGroup = new THREE.Group(), refusedGroup = new THREE.Group(), chosenGroup = new THREE.Group();
const DECISION_COLOURS = { ambiguous: "#d0659a", none: "#8b929b" };
let chosen = null;

function attemptsMesh(attempts, colourOf) {
  const positions = new Float32Array(6 * attempts.length), colours = new Float32Array(6 * attempts.length);
  attempts.forEach((attempt, i) => {
    const colour = new THREE.Color(colourOf(attempt));
    poseAt(rowOf(attempt.match)).toArray(positions, 6 * i);
    poseAt(rowOf(attempt.query)).toArray(positions, 6 * i + 3);
    colour.toArray(colours, 6 * i);
    colour.toArray(colours, 6 * i + 3);
  });
  const mesh = segmentsMesh(positions, null, colours);
  mesh.userData.rows = attempts.map((attempt) => rowOf(attempt.query));
  return mesh;
}

// Bars from camera to camera: lines of WebGL are never wider than a pixel. One mesh for each colour, and one for the
// rims in the colour of the background that set them off from the paths.
const VIEWPOINT_BIN_DEG = 20;
const barGeometry = new THREE.CylinderBufferGeometry(0.58, 0.58, 1, 3, 1, true).rotateX(Math.PI / 2); // 6 triangles

function barMatrix(attempt, times) {
  const from = poseAt(rowOf(attempt.match)), to = poseAt(rowOf(attempt.query)), along = to.clone().sub(from);
  const length = Math.max(0.01, along.length()), width = times * Math.max(0.08, world.extent / 700);
  const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 0, 1), along.divideScalar(length));
  return new THREE.Matrix4().compose(from.add(to).multiplyScalar(0.5), turn, new THREE.Vector3(width, width, length));
}

function barMesh(attempts, degrees, rim = false) {
  const material = new THREE.MeshBasicMaterial({ color: rim ? world.scene.background : viewpointColour(degrees), depthWrite: !rim });
  const mesh = new THREE.InstancedMesh(barGeometry.clone(), material, attempts.length);
  mesh.renderOrder = rim ? 2 : 3; // after the paths
  attempts.forEach((attempt, i) => barMatrix(attempt, rim ? 2 : 1).toArray(mesh.instanceMatrix.array, 16 * i));
  mesh.frustumCulled = false;
  mesh.userData.rows = attempts.map((attempt) => rowOf(attempt.query));
  return mesh;
}

function makeLoops() {
  clearGroup(loopGroup);
  clearGroup(refusedGroup);
  const ordered = run.attempts.filter(inRun).sort((a, b) => a.query - b.query);
  for (let low = 0; low < 180; low += VIEWPOINT_BIN_DEG) {
    const within = (attempt) => attempt.angle >= low && (attempt.angle < low + VIEWPOINT_BIN_DEG || low + VIEWPOINT_BIN_DEG >= 180);
    const accepted = ordered.filter((attempt) => attempt.decision === "accepted" && within(attempt));
    if (accepted.length) loopGroup.add(barMesh(accepted, low + VIEWPOINT_BIN_DEG / 2));
    if (accepted.length) loopGroup.add(barMesh(accepted, 0, true));
  }
  const refused = ordered.filter((attempt) => attempt.decision !== "accepted");
  refusedGroup.add(attemptsMesh(refused, (attempt) => DECISION_COLOURS[attempt.decision]));
}

function showLoopsUntil(last) {
  for (const mesh of [...loopGroup.children, ...refusedGroup.children]) {
    const later = mesh.userData.rows.findIndex((at) => at > last), count = later < 0 ? mesh.userData.rows.length : later;
    if (mesh.isInstancedMesh) [mesh.count, mesh.visible] = [count, count > 0];
    else mesh.geometry.setDrawRange(0, 2 * count);
  }
}

// The cameras of the chosen loop, with lines to the objects that it has matched.
function showChosen() {
  clearGroup(chosenGroup);
  showLayers(); // the other loops make room
  if (!chosen) return;
  if (inRun(chosen)) chosenGroup.add(barMesh([chosen], chosen.angle));
  const ends = [poseAt(rowOf(chosen.match)), poseAt(rowOf(chosen.query))];
  const colours = [correctedColour(), odometryColour()];
  ends.forEach((end, side) => {
    const marker = new THREE.Mesh(new THREE.SphereBufferGeometry(0.6, 16, 12), new THREE.MeshBasicMaterial({ color: colours[side] }));
    marker.position.copy(end);
    chosenGroup.add(marker);
    const positions = [];
    for (let i = 1 - side; i < chosen.pairs.length; i += 2) {
      const object = objectById.get(chosen.pairs[i]) || objectById.get(chosen.pairs[i ^ 1]);
      if (!object) continue;
      positions.push(...end.toArray(), ...objectPoint(object).toArray());
      if (side === 0) chosenGroup.add(objectMesh(object, data.colours.matched));
    }
    chosenGroup.add(segmentsMesh(new Float32Array(positions), colours[side]));
  });
  draw();
}

function pairNames(attempt) {
  const names = [];
  for (let i = 0; i < attempt.pairs.length; i += 2) {
    const [local, global] = [attempt.pairs[i], attempt.pairs[i + 1]];
    const object = objectById.get(global) || objectById.get(local);
    const label = object ? run.labels[object[OBJECT.label]].name + " " : "";
    names.push(label + (local === global ? `${local}` : `${local} = ${global}`));
  }
  return names;
}

// The matched objects as both cameras have seen them.
function cropTable(attempt) {
  const image = (index, frame) => element("td", {}, element("img", { src: "data:image/jpeg;base64," + run.images[index], alt: `seen near frame ${frame}` }));
  const names = pairNames(attempt), heading = (text) => element("th", { className: "text", textContent: text });
  const rows = [[heading(""), ...attempt.crops.map(([pair]) => element("td", { textContent: names[pair] }))],
    [heading(`near ${attempt.query}`), ...attempt.crops.map(([, query]) => image(query, attempt.query))],
    [heading(`near ${attempt.match}`), ...attempt.crops.map(([, , match]) => image(match, attempt.match))]];
  return element("div", { className: "scroll" }, element("table", { className: "crops" }, element("tbody", {}, ...rows.map((cells) => element("tr", {}, ...cells)))));
}

function describeChosen() {
  $("details").hidden = !chosen;
  if (!chosen) return makeRoom();
  const facts = [
    `${chosen.decision}: ${chosen.reason}`,
    `Viewpoint change ${chosen.angle.toFixed(0)}°, log odds ${chosen.score} (second best ${chosen.second})` +
      (chosen.probability === null ? "" : `, probability ${chosen.probability}`),
    chosen.error === null ? "" : `Off by ${chosen.error} m from the ground truth`,
  ];
  const pairs = `${chosen.pairs.length / 2} objects matched: ${pairNames(chosen).join(", ")}`;
  const close = element("button", { type: "button", textContent: "Close" });
  close.onclick = () => chooseLoop(null);
  $("details").replaceChildren(element("strong", { textContent: `Frame ${chosen.query} at frame ${chosen.match}` }), " ", close,
    ...facts.filter(Boolean).map((fact) => element("div", { textContent: fact })), ...(chosen.crops ? [cropTable(chosen)] : []),
    element("div", { textContent: pairs }));
  makeRoom();
}

function chooseLoop(attempt) {
  chosen = attempt;
  describeChosen();
  markChosenRow();
  if (!world.renderer) return;
  if (attempt && rowOf(attempt.query) > row) setRow(rowOf(attempt.query));
  showChosen();
  if (attempt && inRun(attempt)) flyTo(poseAt(rowOf(attempt.query)).add(poseAt(rowOf(attempt.match))).multiplyScalar(0.5), 55);
}
