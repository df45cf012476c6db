// The page of a benchmark: its tables, sorted by any column, and its curves.
// Colours of Okabe and Ito, those that are seen on both backgrounds; dashes and points differ, too.
const METHOD_COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00"];
const METHOD_DASHES = [[], [7, 4], [2, 3]], METHOD_POINTS = ["circle", "rect", "triangle", "crossRot"];

const numberIn = (text) => (/^[-+]?\.?\d/.test(text) ? parseFloat(text) : null);

function compareCells(a, b) {
  if (a === "" || b === "") return (a === "") - (b === "") || 0; // no measurement
  const x = numberIn(a), y = numberIn(b);
  return x === null || y === null ? a.localeCompare(b) : x - y;
}

function benchCell(text) {
  const plain = text.replaceAll("**", ""), made = element("td", { className: plain && numberIn(plain) === null ? "text" : "" });
  made.append(plain === text ? plain || "-" : element("strong", { textContent: plain }));
  return made;
}

function benchTable({ title, header, rows, note }) {
  const made = element("table", {}, element("thead"), element("tbody"));
  let column = -1, down = false;
  const fill = () => {
    const sign = down ? -1 : 1;
    // what is missing stays last, whichever way
    const sorted = column < 0 ? rows : [...rows].sort(({ [column]: a }, { [column]: b }) => (a && b ? sign : 1) * compareCells(a, b));
    made.tHead.replaceChildren(element("tr", {}, ...header.map((name, i) => {
      const arrow = i !== column ? "" : down ? " ▼" : " ▲";
      const button = element("button", { type: "button", textContent: name.replaceAll("**", "") + arrow });
      button.onclick = () => ((down = i === column && !down), (column = i), fill(), made.tHead.rows[0].cells[i].firstChild.focus());
      const cell = element("th", { scope: "col", className: numberIn((rows[0] || [])[i] || "1") === null ? "text" : "" }, button);
      cell.setAttribute("aria-sort", arrow ? (down ? "descending" : "ascending") : "none");
      return cell;
    })));
    made.tBodies[0].replaceChildren(...sorted.map((cells) => element("tr", {}, ...cells.map(benchCell))));
  };
  fill();
  return element("article", {}, element("h2", { textContent: title }), element("div", { className: "scroll rows" }, made),
    element("p", { className: "small", textContent: note.replaceAll("`", "") }));
}

// {name of the method: its rows as objects}, in order.
function byMethod({ header, rows }, wanted = () => true) {
  const methods = new Map();
  for (const cells of rows) {
    const named = Object.fromEntries(header.map((name, i) => [name, cells[i]]));
    if (!methods.has(named.method)) methods.set(named.method, []);
    if (wanted(named)) methods.get(named.method).push(named);
  }
  return methods;
}

const methodLines = (methods, pointOf) => [...methods].map(([name, rows], i) => line(name, rows.map(pointOf), METHOD_COLOURS[i % 6],
  { borderDash: METHOD_DASHES[Math.floor(i / 6) % 3], pointStyle: METHOD_POINTS[i % 4], pointRadius: rows.length < 40 ? 4 : 0, clip: false }));

function benchCharts() {
  for (const old of charts) old.destroy();
  charts = [];
  Chart.defaults.color = ink();
  const pr = data.curves.find(({ key }) => key === "pr_curves"), seen = data.curves.find(({ key }) => key.startsWith("viewpoint"));
  $("pr_panel").hidden = !pr;
  $("viewpoint_panel").hidden = !seen;
  const legend = { plugins: { legend: { labels: { usePointStyle: true } } } };
  const share = (text) => axis(text, { type: "linear", min: 0, max: 1 });
  if (pr) {
    const methods = byMethod(pr, (row) => row.viewpoint_deg === $("pr_bin").value);
    chart("pr_chart", "line", { datasets: methodLines(methods, (row) => ({ x: Number(row.recall), y: Number(row.precision) })) },
      { x: share("recall"), y: share("precision") }, legend);
  }
  if (seen) {
    const labels = [...new Set(seen.rows.map((cells) => cells[1]))];
    chart("viewpoint_chart", "line", { labels, datasets: methodLines(byMethod(seen), (row) => ({ x: row.viewpoint_deg, y: Number(row.recall) })) },
      { x: axis("viewpoint change [degrees]"), y: share("recall") }, legend);
  }
}

function setBenchTheme(theme) {
  document.documentElement.dataset.theme = theme;
  benchCharts();
}

const bins = data.curves.filter(({ key }) => key === "pr_curves").flatMap(({ rows }) => rows.map((cells) => cells[1]));
$("pr_bin").append(...[...new Set(["all", ...bins])].filter((bin) => bins.includes(bin)).map((bin) => element("option", { value: bin, textContent: bin })));
$("pr_bin").onchange = benchCharts;
$("theme").onclick = () => setBenchTheme(isDark() ? "light" : "dark");
window.addEventListener("beforeprint", () => isDark() && setBenchTheme("light"));
const listed = data.curves.filter(({ key }) => key !== "pr_curves" && !key.startsWith("viewpoint"));
$("tables").append(...[...data.tables, ...listed].map(benchTable));
setBenchTheme(matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
