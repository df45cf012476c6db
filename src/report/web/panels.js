// Summary, warnings, provenance, configuration, legend.
const COUNT_NAMES = { frames: "frames", detections_used: "detections used", detections_dropped: "detections dropped",
  landmarks: "landmarks", loops_accepted: "loops accepted", loops_ambiguous: "attempts ambiguous",
  loops_none: "attempts without a place", views_tied: "views tied", odometry_scale: "odometry scale" };

// Long names may break after an underscore.
const breakable = (name) => name.split(/(?<=_)/).flatMap((part) => [element("wbr"), part]);

function valueTable(rows, className) {
  return element("table", {}, element("tbody", {}, ...rows.map(([name, value]) =>
    element("tr", {}, element("td", { className: "text" }, ...breakable(name)), element("td", { className, textContent: value })))));
}

function fillSummary() {
  const rows = Object.entries((run.record && run.record.counts) || {}).map(([name, value]) => [COUNT_NAMES[name] || name, String(value)]);
  const metrics = printedValues(run.metrics).map(([name, value]) => [name, value === "null" ? "-" : value]);
  $("summary").replaceChildren(valueTable([...rows, ...metrics], ""));
}

function fillNotes() {
  const notes = [];
  if (run.stride > 1) notes.push(`Every ${run.stride}th pose is shown.`);
  if (run.objects_left_out) notes.push(`${run.objects_left_out} objects that were seen last are left out.`);
  if (run.attempts_left_out) notes.push("Not all attempts to close a loop are shown.");
  if (run.record && !run.record.complete) notes.push("The run was stopped before its end.");
  if (!run.record) notes.push("No run.json: this run does not say how it was made.");
  if (!run.truth) notes.push("No ground truth was given.");
  if (run.images_note) notes.push(run.images_note);
  $("notes").textContent = notes.join(" ");
}

function fillCheck() {
  const check = run.record && run.record.check;
  if (!check) return $("check").replaceChildren("This run did not test its data: 'sslcd_run check' does.");
  const rows = check.map((one) => {
    const text = one.mistake ? `${one.mistake}: ${one.text}. Try: ${one.fix}` : one.text;
    return element("tr", { className: one.result.replace(" ", "_") }, element("td", { className: "text" }, one.check, element("small", { textContent: one.result })),
      element("td", { className: "text", textContent: text }));
  });
  $("check").replaceChildren(element("table", {}, element("tbody", {}, ...rows)));
}

function fillRecord() {
  const warnings = (run.record && run.record.warnings) || [];
  $("warnings_panel").hidden = warnings.length === 0;
  $("warnings").replaceChildren(...warnings.map((text) => element("li", { textContent: text })));
  $("config").textContent = run.config;
  if (!run.record) return $("record").replaceChildren("unknown");
  const { program, command, dataset, started, wall_s, cpu_s, inputs } = run.record;
  const rows = [["sslcd", `${program.version}, commit ${program.commit}`], ["command", command.join(" ")],
    ["sequence", `${dataset.name} (${dataset.format})`], ["started", started],
    ["time", `${wall_s.toFixed(1)} s, ${cpu_s.toFixed(1)} s of CPU`],
    ...inputs.map((file) => [file.role, `${file.path}, ${file.bytes} bytes` + (file.files ? ` in ${file.files} files` : "") +
      (file.sha256 ? `, SHA-256 ${file.sha256}` : "")])];
  $("record").replaceChildren(valueTable(rows, "text"));
}

function fillLegend() {
  const item = (colour, text, className = "") => {
    const swatch = element("i", { className });
    swatch.style.background = colour;
    return element("li", {}, swatch, text);
  };
  const ramp = [0, 45, 90, 135, 180].map(viewpointColour).join(", ");
  $("legend").replaceChildren(item(odometryColour(), "odometry"), item(correctedColour(), "corrected"),
    ...(run.truth ? [item(truthColour(), "ground truth")] : []), ...run.labels.map((label) => item(label.colour, label.name)),
    item(`linear-gradient(to right, ${ramp})`, "loops, viewpoint change 0 to 180°", "ramp"));
}

function fillLayers() {
  const names = { odometry: "odometry", corrected: "corrected", truth: "ground truth", objects: "objects", loops: "loops",
    refused: "refused attempts", spread: "passes above each other" };
  if (!run.truth) delete names.truth;
  const boxes = Object.entries(names).map(([name, text]) => {
    const box = element("input", { type: "checkbox", checked: name === "spread" ? world.spread : !hidden.has(name) });
    box.dataset.layer = name;
    box.onchange = () => (name === "spread" ? spreadPasses(box.checked) : (hidden[box.checked ? "delete" : "add"](name), showLayers()));
    return element("label", {}, box, " ", text);
  });
  $("layers").replaceChildren(element("legend", { textContent: "Show" }), ...boxes);
}

function spreadPasses(on) {
  world.spread = on;
  document.querySelector("[data-layer=spread]").checked = on;
  makeMoving();
}
