// The attempts to close a loop, sorted by any column.
const COLUMNS = [["query", "Frame"], ["match", "at frame"], ["angle", "Viewpoint [°]"], ["matches", "Objects"], ["probability", "Probability"],
  ["score", "Log odds"], ["error", "Error [m]"], ["decision", "Decision", "text"], ["reason", "Reason", "text"]];
const table = { column: "query", down: false, all: false };
const ROWS_AT_FIRST = 150;
const cellValue = (attempt, column) => (column === "matches" ? attempt.pairs.length / 2 : attempt[column]);

function sortedAttempts() {
  const wanted = $("decision").value, sign = table.down ? -1 : 1;
  return run.attempts.filter((attempt) => !wanted || attempt.decision === wanted).sort((a, b) => {
    const x = cellValue(a, table.column), y = cellValue(b, table.column);
    if (x === null || y === null) return (x === null) - (y === null); // unknown ones last
    return sign * (x < y ? -1 : x > y ? 1 : 0) || a.query - b.query;
  });
}

function cell(attempt, column, kind) {
  const value = cellValue(attempt, column);
  if (column === "query") {
    const button = element("button", { type: "button", textContent: value });
    button.title = "show this loop on the map";
    return element("td", {}, button);
  }
  const made = element("td", { className: kind || "", textContent: value === null ? "-" : value });
  if (column === "angle") {
    const dot = element("i");
    dot.style.background = viewpointColour(value);
    made.prepend(dot);
  }
  return made;
}

function fillTable() {
  const attempts = sortedAttempts(), shown = table.all ? attempts : attempts.slice(0, ROWS_AT_FIRST);
  $("loops").tHead.replaceChildren(element("tr", {}, ...COLUMNS.map(([column, name, kind]) => {
    const arrow = column !== table.column ? "" : table.down ? " ▼" : " ▲";
    const button = element("button", { type: "button", textContent: name + arrow });
    button.onclick = () => {
      table.down = column === table.column && !table.down;
      table.column = column;
      fillTable();
      $("loops").tHead.rows[0].cells[COLUMNS.findIndex(([c]) => c === column)].firstChild.focus();
    };
    const header = element("th", { className: kind || "", scope: "col" }, button);
    header.setAttribute("aria-sort", arrow ? (table.down ? "descending" : "ascending") : "none");
    return header;
  })));
  $("loops").tBodies[0].replaceChildren(...shown.map((attempt) => {
    const made = element("tr", {}, ...COLUMNS.map(([column, , kind]) => cell(attempt, column, kind)));
    made.attempt = attempt;
    made.onclick = () => {
      chooseLoop(attempt);
      $("map").scrollIntoView({ block: "nearest" });
    };
    return made;
  }));
  $("attempt_count").textContent = `${attempts.length} of ${run.attempts.length} attempts`;
  $("more").hidden = shown.length === attempts.length;
  $("more").textContent = `Show all ${attempts.length}`;
  markChosenRow();
}

function markChosenRow() {
  for (const made of $("loops").tBodies[0].rows) made.classList.toggle("chosen", made.attempt === chosen);
}
