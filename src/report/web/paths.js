// Trajectories as lines of few segments: software renderers pay for each of them.
const PATH_TOLERANCE = 1 / 4000; // of the extent: a quarter of a pixel where all of the map is shown

// Rows between which straight lines stay within the tolerance of all points (Douglas and Peucker, 1973).
function keptRows(at, first, last, tolerance) {
  const kept = [first, last], open = [[first, last]];
  while (open.length) {
    const [from, to] = open.pop(), line = new THREE.Line3(at[from], at[to]), nearest = new THREE.Vector3();
    let furthest = tolerance * tolerance, middle = -1;
    for (let i = from + 1; i < to; ++i) {
      const off = line.closestPointToPoint(at[i], true, nearest).distanceToSquared(at[i]);
      if (off > furthest) [furthest, middle] = [off, i];
    }
    if (middle < 0) continue;
    kept.push(middle);
    open.push([from, middle], [middle, to]);
  }
  return kept.sort((a, b) => a - b);
}

// [from, to] of each segment; none where a row has no position.
function pathSegments(at) {
  const segments = [], tolerance = Math.max(0.01, PATH_TOLERANCE * world.extent);
  for (let first = 0; first < at.length; ++first) {
    if (!at[first]) continue;
    let last = first;
    while (at[last + 1]) ++last;
    const rows = last > first ? keptRows(at, first, last, tolerance) : [];
    for (let i = 1; i < rows.length; ++i) segments.push([rows[i - 1], rows[i]]);
    first = last;
  }
  return segments;
}

function pathMesh(flat, colour) {
  const at = [];
  for (let i = 0; 3 * i < flat.length; ++i) {
    at.push(flat[3 * i] === null ? null : point(flat, i));
    if (at[i]) at[i].y += lift(i);
  }
  const segments = pathSegments(at), positions = new Float32Array(6 * segments.length);
  segments.forEach(([from, to], i) => (at[from].toArray(positions, 6 * i), at[to].toArray(positions, 6 * i + 3)));
  const mesh = segmentsMesh(positions, colour);
  mesh.userData = { at, segments, cut: -1 };
  mesh.renderOrder = 1;
  mesh.material.depthWrite = false; // the rims of loops cover it
  return mesh;
}

function moveEnd(mesh, segment, to) {
  to.toArray(mesh.geometry.attributes.position.array, 6 * segment + 3);
  mesh.geometry.attributes.position.needsUpdate = true;
}

// Shows the path up to a row, which may lie within a segment.
function showPathUntil(mesh, last) {
  const { at, segments, cut } = mesh.userData;
  let low = 0, high = segments.length; // the segments that begin before the row
  while (low < high) {
    const middle = (low + high) >> 1;
    if (segments[middle][0] < last) low = middle + 1;
    else high = middle;
  }
  const within = low > 0 && segments[low - 1][1] > last ? low - 1 : -1;
  if (cut >= 0 && cut !== within) moveEnd(mesh, cut, at[segments[cut][1]]);
  if (within >= 0) moveEnd(mesh, within, at[last]);
  mesh.userData.cut = within;
  mesh.geometry.setDrawRange(0, 2 * low);
}
