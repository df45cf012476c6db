// Charts; made anew for each run and theme.
let charts = [];
const CHART_COLOURS = { x: "#0072b2", y: "#d55e00", z: "#009e73", accepted: "#0072b2", ambiguous: "#d0659a", none: "#8b929b" };

function chart(id, type, chartData, scales, more = {}) {
  charts.push(new Chart($(id), { type, data: chartData,
    options: { animation: false, maintainAspectRatio: false, scales, ...more } }));
}

const axis = (text, more = {}) => ({ title: { display: Boolean(text), text }, grid: { color: isDark() ? "#3a414b" : "#e3e6ea" }, ...more });
const line = (label, points, borderColor, more = {}) => ({ label, data: points, borderColor, backgroundColor: borderColor, borderWidth: 1.4, pointRadius: 0, ...more });

function errorChart() {
  $("error_panel").hidden = !run.truth;
  if (!run.truth) return;
  const every = Math.max(1, Math.ceil(rowCount() / 1200)), points = { x: [], y: [], z: [], all: [] };
  for (let i = 0; i < rowCount(); i += every) {
    if (run.truth[3 * i] === null) continue;
    const off = point(run.corrected, i).sub(point(run.truth, i)), x = run.stamps[i];
    points.x.push({ x, y: off.x });
    points.y.push({ x, y: -off.z });
    points.z.push({ x, y: off.y });
    points.all.push({ x, y: off.length() });
  }
  chart("error_chart", "line", { datasets: [line("x", points.x, CHART_COLOURS.x), line("y", points.y, CHART_COLOURS.y, { borderDash: [6, 3] }),
    line("z", points.z, CHART_COLOURS.z, { borderDash: [2, 2] }), line("distance", points.all, ink())] },
    { x: axis("time [s]", { type: "linear" }), y: axis("") }, { parsing: false, normalized: true });
}

function viewpointChart() {
  const bins = 12, counts = { accepted: Array(bins).fill(0), ambiguous: Array(bins).fill(0), none: Array(bins).fill(0) };
  for (const attempt of run.attempts) ++counts[attempt.decision][Math.min(bins - 1, Math.floor(attempt.angle / 15))];
  chart("viewpoint_chart", "bar", { labels: [...Array(bins).keys()].map((i) => `${15 * i}-${15 * i + 15}`),
    datasets: Object.entries(counts).map(([label, values]) => ({ label, data: values, backgroundColor: CHART_COLOURS[label] })) },
    { x: axis("", { stacked: true }), y: axis("", { stacked: true, ticks: { precision: 0 } }) });
}

function recallChart() {
  $("recall_panel").hidden = !run.recall.some(([revisits]) => revisits);
  if ($("recall_panel").hidden) return;
  const width = 180 / run.recall.length, share = (part, all) => (all ? part / all : null);
  const counted = [["recall", ([revisits, recognised]) => [recognised, revisits, "places"], CHART_COLOURS.x],
    ["precision", ([, , loops, right]) => [right, loops, "loops"], CHART_COLOURS.y]];
  const datasets = counted.map(([label, count, backgroundColor]) => ({ label, backgroundColor, counts: run.recall.map(count),
    data: run.recall.map((bin) => share(...count(bin))) }));
  const tip = ({ dataset, dataIndex }) => { const [part, all, what] = dataset.counts[dataIndex]; return `${dataset.label}: ${part} of ${all} ${what}`; };
  chart("recall_chart", "bar", { labels: run.recall.map(([revisits], i) => [`${width * i}`, `(${revisits})`]), datasets },
    { x: axis("viewpoint change from [degrees] (places)"), y: axis("", { min: 0, max: 1 }) }, { plugins: { tooltip: { callbacks: { label: tip } } } });
}

function reliabilityChart() {
  const edges = [0, 0.2, 0.4, 0.6, 0.8, 0.9, 0.99, 0.999, 1.000001];
  const judged = run.attempts.filter((attempt) => attempt.error !== null && attempt.probability !== null);
  $("reliability_panel").hidden = judged.length === 0;
  if (judged.length === 0) return;
  const bins = edges.slice(1).map((high, i) => judged.filter((a) => a.probability >= edges[i] && a.probability < high));
  const names = edges.slice(1).map((high, i) => `${edges[i]}-${Math.min(1, high)} (${bins[i].length})`);
  const shares = bins.map((bin) => (bin.length ? bin.filter((a) => a.error < 5).length / bin.length : null));
  chart("reliability_chart", "bar", { labels: names, datasets: [{ label: "share that is right", data: shares, backgroundColor: CHART_COLOURS.x }] },
    { x: axis("probability (attempts)"), y: axis("", { min: 0, max: 1 }) });
}

function timingChart() {
  const stages = Object.entries(JSON.parse(run.timing));
  $("timing_chart").parentElement.style.height = `${90 + 24 * stages.length}px`;
  chart("timing_chart", "bar", { labels: stages.map(([name]) => name),
    datasets: [{ label: "p50", data: stages.map(([, t]) => t.p50_ms), backgroundColor: CHART_COLOURS.x },
      { label: "p95", data: stages.map(([, t]) => t.p95_ms), backgroundColor: CHART_COLOURS.y }] },
    { x: axis("ms", { type: "logarithmic" }), y: axis("") }, { indexAxis: "y" });
}

function makeCharts() {
  for (const old of charts) old.destroy();
  charts = [];
  Chart.defaults.color = ink();
  for (const make of [errorChart, viewpointChart, recallChart, reliabilityChart, timingChart]) make();
}
