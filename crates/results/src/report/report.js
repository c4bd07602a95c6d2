// What a page adds for readers with scripts: tables to sort and filter, curves to zoom, data to take along.
const make = (tag, attributes = {}, ...children) => {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false) element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
};
const button = (text, onclick, more = {}) => make("button", { type: "button", onclick, ...more }, text);
const digits = (value, count = 5) => (Number.isFinite(value) ? String(Number(value.toPrecision(count))) : "–");

// Numbers: each array is its entry's share of one deflated block, all first bytes before all second ones. Whole numbers
// and levels are there component by component, as twice the difference from the one before.
async function unpack(entries, block) {
  const packed = Uint8Array.from(atob(block), (character) => character.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  let start = 0;
  return entries.map(([kind, width, count, ...how]) => {
    if (kind === "p") return Float64Array.from({ length: count }, (_, i) => how[0] + i * how[1]);
    const own = bytes.subarray(start, (start += width * count));
    if (kind === "t") return JSON.parse(new TextDecoder().decode(own));
    const words = new Uint32Array(count);
    own.forEach((byte, i) => (words[i % count] |= byte << (8 * Math.floor(i / count))));
    if (kind === "f") return Float64Array.from(new Float32Array(words.buffer));
    for (let pass = 0; pass < 2; pass++) for (let i = 1; i < count; i++) words[i] += words[i - 1];
    const [components, low, high] = how, beyond = 256 ** width - 1;
    return Float64Array.from(words, (_, i) => {
      const word = (words[(i % components) * (count / components) + Math.floor(i / components)] & beyond) >>> 0;
      return kind === "i" ? word : word === beyond ? NaN : low + (word / (beyond - 1)) * (high - low);
    });
  });
}

// Tables.
function equipTable(table) {
  // A point of a study has a file with everything that was found there.
  if (table.tHead?.rows[0].cells[0].textContent === "point")
    for (const row of table.tBodies[0].rows) {
      const cell = row.cells[0], number = cell.textContent.trim();
      cell.replaceChildren(make("a", { href: `points/point-${number.padStart(6, "0")}.json` }, number));
    }
  const body = table.tBodies[0], rows = [...body.rows];
  if (!table.tHead || rows.length < 3) return;
  [...table.tHead.rows[0].cells].forEach((head, column) => {
    const sort = () => {
      const falls = head.getAttribute("aria-sort") === "ascending";
      for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
      head.setAttribute("aria-sort", falls ? "descending" : "ascending");
      const text = (row) => row.cells[column].textContent.trim();
      const compare = (a, b) => {
        const [one, two] = [text(a), text(b)];
        // Empty cells stay last either way.
        if (one === "" || two === "") return (one === "") - (two === "");
        const numbers = [Number(one), Number(two)];
        const order = numbers.some(Number.isNaN) ? one.localeCompare(two, "en", { numeric: true }) : numbers[0] - numbers[1];
        return falls ? -order : order;
      };
      body.append(...rows.sort(compare));
    };
    const text = head.textContent;
    head.replaceChildren(button(text, sort, { title: "Sort by " + text }));
  });
  if (rows.length < 8) return;
  const count = make("output", {}, `${rows.length} rows`);
  const filter = make("input", { type: "search" });
  filter.addEventListener("input", () => {
    const words = filter.value.toLowerCase().split(/\s+/);
    rows.forEach((row) => {
      const cells = [...row.cells].map((cell) => cell.textContent.toLowerCase());
      row.hidden = !words.every((word) => cells.some((cell) => cell.includes(word)));
    });
    count.textContent = `${rows.filter((row) => !row.hidden).length} of ${rows.length} rows`;
  });
  table.parentElement.before(make("div", { class: "tools" }, make("label", {}, "Filter rows ", filter), count));
}

// Data of a figure as a table: columns with the same abscissae share them.
function csvOf(figure) {
  const columns = [];
  let last;
  const add = (name, values) => columns.push({ name, values });
  figure.panels.forEach((panel) => {
    panel.series.forEach((series) => {
      const of = (title) => [panel.caption, series.kind === "field" ? "" : series.name, title].filter(Boolean).join(": ");
      if (series.kind === "field") {
        if (last !== series.x) add("x (m)", series.xs), add("y (m)", series.ys);
        add(of(series.name), series.values);
      } else {
        if (last !== series.x) add(panel.x.title, series.xs);
        add(of(panel.y.title), series.ys);
      }
      last = series.x;
    });
  });
  // No text may become a formula of a spreadsheet.
  const tame = (text) => (/^[=+\-@\t\r]/.test(text) ? "'" + text : text);
  const quote = (text) => (/[",\r\n]/.test(text) ? `"${tame(text).replaceAll('"', '""')}"` : tame(text));
  const lines = [columns.map((column) => quote(column.name)).join(",")];
  const length = Math.max(0, ...columns.map((column) => column.values.length));
  for (let row = 0; row < length; row++) {
    const cells = columns.map(({ values }) => (row < values.length && Number.isFinite(values[row]) ? digits(values[row], 8) : ""));
    lines.push(cells.join(","));
  }
  return lines.join("\n") + "\n";
}
function download(name, type, content) {
  const address = URL.createObjectURL(new Blob([content], { type }));
  make("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}

// One panel to zoom into; `overlay` draws more, `pick` gets the row of a table that a clicked point stands for.
function plotPanel(panel, holder, { overlay, pick } = {}) {
  const curves = panel.series.filter((series) => series.kind !== "field");
  const hidden = new Set();
  const extent = (axis, key) => {
    let [low, high] = panel[axis].ends;
    if (panel[axis].log) low = Math.max(low, high * 1e-300);
    return { key, low, high };
  };
  const all = [extent("x", "xs"), extent("y", "ys")];
  const isShown = (series) => !hidden.has(series);
  const path = (u, series) => {
    const { ctx } = u, { xs, ys } = series;
    const place = (i) => [u.valToPos(xs[i], "x", true), u.valToPos(ys[i], "y", true)];
    ctx.strokeStyle = ctx.fillStyle = series.colour;
    ctx.beginPath();
    let pen = false;
    for (let i = 0; i < xs.length; i++) {
      const [x, y] = place(i);
      const isPlace = Number.isFinite(x) && Number.isFinite(y);
      if (isPlace && series.kind === "points") ctx.moveTo(x + 3, y), ctx.arc(x, y, 3, 0, 7);
      else if (isPlace) pen ? ctx.lineTo(x, y) : ctx.moveTo(x, y);
      pen = isPlace;
    }
    ctx.setLineDash(series.kind === "dashed" ? [6, 4] : []);
    series.kind === "points" ? ctx.fill() : ctx.stroke();
  };
  const draw = (u) => {
    const { ctx, bbox } = u;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    ctx.lineWidth = devicePixelRatio;
    ctx.strokeStyle = "#555";
    ctx.setLineDash([]);
    for (const [isHorizontal, value] of panel.rules) {
      const at = u.valToPos(value, isHorizontal ? "y" : "x", true);
      ctx.beginPath();
      isHorizontal ? (ctx.moveTo(bbox.left, at), ctx.lineTo(bbox.left + bbox.width, at)) : (ctx.moveTo(at, bbox.top), ctx.lineTo(at, bbox.top + bbox.height));
      ctx.stroke();
    }
    ctx.lineWidth = 1.2 * devicePixelRatio;
    ctx.lineJoin = "round";
    curves.filter(isShown).forEach((series) => path(u, series));
    ctx.font = `bold ${12 * devicePixelRatio}px sans-serif`;
    ctx.setLineDash([]);
    for (const [x, y, text] of panel.labels) {
      const place = [u.valToPos(x, "x", true) + 5 * devicePixelRatio, u.valToPos(y, "y", true) - 4 * devicePixelRatio];
      ctx.strokeStyle = "#fff";
      ctx.lineWidth = 3 * devicePixelRatio;
      ctx.strokeText(text, ...place);
      ctx.fillStyle = "#222";
      ctx.fillText(text, ...place);
    }
    overlay?.draw(u);
    ctx.restore();
  };
  const readout = make("output", { class: "readout" }, "");
  const dot = make("span", { class: "dot", hidden: true });
  let found;
  const nearest = (u, left, top) => {
    const best = { distance: 40 };
    for (const series of curves.filter(isShown)) {
      const { xs, ys, isSorted } = series;
      let from = 0, to = xs.length;
      if (isSorted) {
        const at = u.posToVal(left, "x");
        let low = 0, high = xs.length;
        while (low < high) {
          const middle = (low + high) >> 1;
          xs[middle] < at ? (low = middle + 1) : (high = middle);
        }
        [from, to] = [Math.max(0, low - 150), Math.min(xs.length, low + 150)];
      }
      for (let i = from; i < to; i++) {
        // A point that stands for a run or has a name comes before the line through it.
        const distance = Math.hypot(u.valToPos(xs[i], "x") - left, u.valToPos(ys[i], "y") - top) - (series.rows || series.tips ? 3 : 0);
        if (distance < best.distance) Object.assign(best, { distance, series, i });
      }
    }
    return best.series && best;
  };
  const show = (u, point) => {
    found = point;
    dot.hidden = !point;
    if (!point) return;
    const { series, i } = point, [x, y] = [series.xs[i], series.ys[i]];
    dot.style.transform = `translate(${u.valToPos(x, "x")}px,${u.valToPos(y, "y")}px)`;
    const name = series.tips ? series.tips[i] + "; " : series.name && series.name + ": ";
    readout.textContent = `${name}${panel.x.title} ${digits(x, 6)}, ${panel.y.title} ${digits(y)}`;
  };
  const picked = () => pick && found?.series.rows && pick(found.series.rows[found.i]);
  const scale = (axis) => ({ time: false, auto: false, distr: panel[axis].log ? 3 : 1, range: (_, low, high) => [low, high] });
  const axis = (title) => ({ label: title, stroke: "#222", grid: { stroke: "#ddd", width: 1 }, ticks: { stroke: "#888", width: 1 }, font: "12px sans-serif", labelFont: "13px sans-serif", size: 62 });
  const box = make("div", { class: "plot", tabindex: 0, role: "group", "aria-label": `${panel.caption || panel.y.title}. Arrow keys move, plus and minus zoom, 0 shows all, comma and period read the points.` });
  holder.append(box);
  const width = () => Math.max(240, box.clientWidth);
  const u = new uPlot({
    width: width(), height: Math.max(240, Math.min(420, 0.6 * width())),
    legend: { show: false },
    cursor: { drag: { x: true, y: true, uni: 20, setScale: true }, points: { show: false }, bind: { dblclick: () => () => reset() } },
    scales: { x: scale("x"), y: scale("y") },
    axes: [{ ...axis(panel.x.title), size: 44 }, axis(panel.y.title)],
    series: [{}, {}],
    hooks: { draw: [draw], setCursor: [(u) => u.cursor.left >= 0 && show(u, nearest(u, u.cursor.left, u.cursor.top))], ready: [(u) => u.over.append(dot)] },
  }, [[all[0].low, all[0].high], [null, null]], box);
  const view = () => ["x", "y"].map((key) => [u.scales[key].min, u.scales[key].max]);
  const set = (ranges) => u.batch(() => ["x", "y"].forEach((key, i) => u.setScale(key, { min: ranges[i][0], max: ranges[i][1] })));
  const reset = () => set(all.map(({ low, high }) => [low, high]));
  // Moves by a share of the view, then zooms about its middle; on a logarithmic axis in its decades.
  const change = (factor, move = [0, 0]) => set(view().map(([low, high], i) => {
    const isLog = panel["xy"[i]].log, to = isLog ? Math.log10 : Number, from = isLog ? (v) => 10 ** v : Number;
    const [a, b] = [to(low), to(high)], middle = 0.5 * (a + b) + move[i] * (b - a), half = 0.5 * factor * (b - a);
    return [from(middle - half), from(middle + half)];
  }));
  reset();
  u.over.addEventListener("click", (event) => {
    const { left, top } = u.over.getBoundingClientRect();
    show(u, nearest(u, event.clientX - left, event.clientY - top));
    picked();
  });
  const step = (by) => {
    const series = found?.series ?? curves.find(isShown);
    if (series) show(u, { series, i: Math.min(series.xs.length - 1, Math.max(0, (found ? found.i : -1) + by)) });
  };
  const keys = { "+": () => change(0.5), "=": () => change(0.5), "-": () => change(2), 0: reset, ArrowLeft: () => change(1, [-0.2, 0]), ArrowRight: () => change(1, [0.2, 0]), ArrowUp: () => change(1, [0, 0.2]), ArrowDown: () => change(1, [0, -0.2]), ",": () => step(-1), ".": () => step(1), Enter: picked };
  box.addEventListener("keydown", (event) => {
    if (event.target !== box || !keys[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    keys[event.key]();
  });
  new ResizeObserver(() => box.clientWidth && u.setSize({ width: width(), height: u.height })).observe(box);
  const tools = make("div", { class: "tools" }, button("Zoom in", () => change(0.5)), button("Zoom out", () => change(2)), button("All", reset));
  // Curves of one name and colour are switched together.
  const groups = Map.groupBy ? Map.groupBy(curves, (s) => s.name + s.colour) : curves.reduce((map, s) => map.set(s.name + s.colour, [...(map.get(s.name + s.colour) ?? []), s]), new Map());
  for (const members of groups.values()) {
    const key = make("span", { class: "key " + members[0].kind });
    key.style.color = members[0].colour;
    const toggle = button(key, () => {
      const isOff = toggle.getAttribute("aria-pressed") === "true";
      toggle.setAttribute("aria-pressed", !isOff);
      members.forEach((series) => (isOff ? hidden.add(series) : hidden.delete(series)));
      show(u, undefined);
      u.redraw(false);
    }, { "aria-pressed": "true", class: "series" });
    toggle.append(members[0].name || "(no name)");
    if (members[0].name) tools.append(toggle);
  }
  holder.append(tools, readout);
  box.plot = u;
  return u;
}
