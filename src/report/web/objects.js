// Objects as instances of one shape for each label, in order of the frame that saw them first.
const objectGroup = new THREE.Group();
const OBJECT = { id: 0, label: 1, x: 2, yaw: 5, length: 6, width: 7, height: 8, seen: 9, first: 10 };
let objectById = new Map();

const objectPoint = (object) => point(object.slice(OBJECT.x, OBJECT.x + 3), 0);

function objectMatrix(object) {
  const turn = new THREE.Quaternion().setFromAxisAngle(new THREE.Vector3(0, 1, 0), object[OBJECT.yaw] * 1e-3);
  const size = new THREE.Vector3(object[OBJECT.length], object[OBJECT.height], object[OBJECT.width]);
  return new THREE.Matrix4().compose(objectPoint(object), turn, size.multiplyScalar(1e-3));
}

const boxGeometry = new THREE.BoxBufferGeometry(1, 1, 1);
const roundGeometry = new THREE.CylinderBufferGeometry(0.5, 0.5, 1, 10);

// Points in the middles: what is smaller than a few pixels, like a tree in a park, is seen from afar, too.
function objectPoints(objects, colour) {
  const geometry = new THREE.BufferGeometry(), positions = new Float32Array(3 * objects.length);
  objects.forEach((object, i) => objectPoint(object).toArray(positions, 3 * i));
  geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  const points = new THREE.Points(geometry, new THREE.PointsMaterial({ size: 5, sizeAttenuation: false }));
  points.frustumCulled = false;
  points.userData = { colour, first: objects.map((object) => object[OBJECT.first]) };
  return points;
}

function paintObjects() {
  for (const { isPoints, material, userData } of objectGroup.children)
    if (isPoints) material.color.set(userData.colour).multiplyScalar(isDark() ? 1 : 0.72);
}

function makeObjects() {
  for (const child of [...objectGroup.children]) objectGroup.remove(child);
  objectById = new Map(run.objects.map((object) => [object[OBJECT.id], object]));
  run.labels.forEach((label, index) => {
    const objects = run.objects.filter((object) => object[OBJECT.label] === index);
    const material = new THREE.MeshLambertMaterial({ color: label.colour });
    const mesh = new THREE.InstancedMesh(label.round ? roundGeometry : boxGeometry, material, objects.length);
    objects.forEach((object, i) => objectMatrix(object).toArray(mesh.instanceMatrix.array, 16 * i));
    mesh.frustumCulled = false;
    mesh.userData.first = objects.map((object) => object[OBJECT.first]);
    objectGroup.add(mesh, objectPoints(objects, label.colour));
  });
}

function showObjectsUntil(frame) {
  for (const mesh of objectGroup.children) {
    let low = 0, high = mesh.userData.first.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (mesh.userData.first[middle] <= frame) low = middle + 1;
      else high = middle;
    }
    if (mesh.isPoints) mesh.geometry.setDrawRange(0, low);
    else mesh.count = low;
    mesh.visible = low > 0;
  }
}

function objectMesh(object, colour) {
  const round = run.labels[object[OBJECT.label]].round;
  const mesh = new THREE.Mesh((round ? roundGeometry : boxGeometry).clone(), new THREE.MeshLambertMaterial({ color: colour }));
  mesh.applyMatrix(objectMatrix(object));
  mesh.scale.multiplyScalar(1.06);
  return mesh;
}
