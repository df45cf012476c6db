// What all parts share: the data, the chosen run, and small helpers.
const data = JSON.parse(document.getElementById("data").textContent);
const $ = (id) => document.getElementById(id);
let run = data.runs && data.runs[0]; // none: a benchmark
let row = 0; // of the trajectory that is shown: the time of the replay

function element(tag, properties, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

const rowCount = () => run.stamps.length;
const rowOf = (frame) => Math.min(Math.floor(frame / run.stride), rowCount() - 1);
const inRun = (attempt) => attempt.query < rowCount() * run.stride && attempt.match < rowCount() * run.stride;
const isDark = () => document.documentElement.dataset.theme === "dark";
const ink = () => getComputedStyle(document.documentElement).getPropertyValue("--ink").trim();

// The ends of the palette that are hard to see on the background are left out.
function viewpointColour(degrees) {
  const last = data.viewpoint_colours.length - 1, share = Math.min(1, Math.abs(degrees) / 180);
  return data.viewpoint_colours[Math.round(last * (isDark() ? 0.45 + 0.55 * share : 0.88 * share))];
}

const odometryColour = () => (isDark() ? "#ff8a3d" : data.colours.odometry);
// Lighter than in pictures: loops between the same viewpoints are dark blue.
const correctedColour = () => (isDark() ? "#58b4f0" : "#2196e8");
const truthColour = () => (isDark() ? ink() : "#868e98");

// Names and values of a flat JSON object, each as it is printed there.
function printedValues(text) {
  return [...text.matchAll(/"((?:[^"\\]|\\.)*)"\s*:\s*([^,\n}]+)/g)].map((m) => [m[1], m[2].trim()]);
}
