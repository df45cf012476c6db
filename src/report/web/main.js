// Puts the page together.
let has3d = false;

function makeMoving() {
  makePaths();
  makeLoops();
  showLayers();
  setRow(row);
  showChosen();
}

function makeScene() {
  const box = new THREE.Box3();
  for (let i = 0; i < rowCount(); ++i) box.expandByPoint(point(run.corrected, i));
  const size = box.getSize(new THREE.Vector3());
  world.extent = Math.max(20, size.x, size.z);
  makeObjects();
  const low = run.objects.map((object) => object[OBJECT.x + 1] - object[OBJECT.height] / 2).sort((a, b) => a - b);
  world.ground = low.length ? low[Math.floor(low.length / 2)] * 1e-3 : box.min.y - 1.5;
  if (world.grid) world.scene.remove(world.grid);
  const decade = Math.pow(10, Math.floor(Math.log10(world.extent / 8)));
  const cell = decade * [5, 2, 1].find((times) => times * decade <= world.extent / 8);
  const cells = 2 * Math.ceil((0.8 * world.extent) / cell);
  world.grid = new THREE.GridHelper(cells * cell, cells);
  box.getCenter(world.grid.position).setY(world.ground);
  world.scene.add(world.grid);
  paintScene();
}

function paintScene() {
  const style = getComputedStyle(document.documentElement);
  world.scene.background = new THREE.Color(style.getPropertyValue("--stage").trim());
  world.grid.material.vertexColors = THREE.NoColors || false;
  world.grid.material.color.set(isDark() ? "#3c434d" : "#d3d8de");
  paintObjects();
  makeMoving();
}

function showRun(index) {
  run = data.runs[index];
  chosen = null;
  play(false);
  $("title").textContent = run.name;
  $("time").max = rowCount() - 1;
  row = rowCount() - 1;
  fillNotes();
  fillSummary();
  fillCheck();
  fillRecord();
  fillLegend();
  fillLayers();
  if (has3d) {
    makeScene();
    setView(view.mode);
  }
  setRow(rowCount() - 1);
  describeChosen();
  fillTable();
  setTimeout(makeCharts, 0); // after the first frame of the map
}

function setTheme(theme) {
  document.documentElement.dataset.theme = theme;
  fillLegend();
  fillTable();
  if (has3d) paintScene();
  makeCharts();
}

// With the camera of the run one starts where it started.
function chooseView(mode) {
  const first = mode === "driver" && row === rowCount() - 1;
  setView(mode);
  setRow(first ? 0 : row);
}

function connect() {
  data.runs.forEach((each, i) => $("run").append(element("option", { value: i, textContent: each.name })));
  $("run_choice").hidden = data.runs.length < 2;
  $("run").onchange = () => showRun(Number($("run").value));
  $("theme").onclick = () => setTheme(isDark() ? "light" : "dark");
  $("time").oninput = () => (play(false), setRow(Number($("time").value)));
  $("play").onclick = () => play(!playing);
  $("decision").onchange = fillTable;
  $("more").onclick = () => ((table.all = true), fillTable());
  for (const button of $("views").children) button.onclick = () => has3d && chooseView(button.dataset.view);
  // dark lines on paper
  window.addEventListener("beforeprint", () => isDark() && setTheme("light"));
}

document.documentElement.dataset.theme = matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
has3d = startWorld();
if (has3d) for (const group of [pathGroup, objectGroup, loopGroup, refusedGroup, chosenGroup]) world.scene.add(group);
connect();
showRun(0);
window.report = { data, world, view, state: () => ({ row, chosen, playing }), setRow, drawNow }; // for tests
