// The scene, its camera, and when it is drawn.
const world = { spread: false, extent: 100, ground: 0 };
const hidden = new Set(["refused"]); // layers

function startWorld() {
  try {
    world.renderer = new THREE.WebGLRenderer({ canvas: $("scene"), antialias: true, preserveDrawingBuffer: true });
  } catch (problem) {
    $("no_webgl").hidden = false;
    $("scene").hidden = true;
    return false;
  }
  world.scene = new THREE.Scene();
  world.camera = new THREE.PerspectiveCamera(50, 1, 0.3, 1e5);
  world.controls = new THREE.OrbitControls(world.camera, $("scene"));
  world.controls.addEventListener("change", draw);
  world.scene.add(new THREE.HemisphereLight(0xffffff, 0x8a8f98, 0.7));
  const sun = new THREE.DirectionalLight(0xffffff, 0.35);
  sun.position.set(0.4, 1, 0.6);
  world.scene.add(sun);
  new ResizeObserver(resize).observe($("scene"));
  return true;
}

let drawing = false;
function draw() {
  if (drawing || !world.renderer) return;
  drawing = true;
  requestAnimationFrame(drawNow);
}

function drawNow() {
  drawing = false;
  world.renderer.render(world.scene, world.camera);
  if (!world.first_frame_ms) world.first_frame_ms = performance.now();
}

// The middle of the view is beside the box that describes the chosen loop; on narrow screens that is below the map.
function makeRoom() {
  if (!world.renderer) return;
  const scene = $("scene"), box = $("details"), over = !box.hidden && getComputedStyle(box).position === "absolute";
  if (over && view.mode !== "driver") world.camera.setViewOffset(scene.clientWidth, scene.clientHeight, box.offsetWidth / 2, 0, scene.clientWidth, scene.clientHeight);
  else world.camera.clearViewOffset();
  draw();
}

function resize() {
  const width = $("scene").clientWidth, height = $("scene").clientHeight;
  world.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
  world.renderer.setSize(width, height, false);
  world.camera.aspect = width / Math.max(1, height);
  world.camera.updateProjectionMatrix();
  makeRoom();
  drawNow(); // a canvas that was resized is empty
}

function point(flat, i) {
  return new THREE.Vector3(flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]).multiplyScalar(1e-3);
}

// How much higher a row is shown, so that passes at one place lie above each other.
const lift = (i) => (world.spread ? (0.35 * world.extent * i) / Math.max(1, rowCount()) : 0);

function poseAt(i) {
  const at = point(run.corrected, i);
  at.y += lift(i);
  return at;
}

function clearGroup(group) {
  for (const child of [...group.children]) {
    group.remove(child);
    child.geometry.dispose();
    child.material.dispose();
  }
}

function segmentsMesh(positions, colour, colours) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  if (colours) geometry.setAttribute("color", new THREE.BufferAttribute(colours, 3));
  const material = new THREE.LineBasicMaterial(
    colours ? { vertexColors: THREE.VertexColors || true } : { color: colour });
  const mesh = new THREE.LineSegments(geometry, material);
  mesh.frustumCulled = false;
  return mesh;
}
