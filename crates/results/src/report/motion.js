// Motion, sound, and points that move with a parameter.
const statusColours = ["#8c8c8c", "#0072b2", "#e69f00"], statusNames = ["open", "stick", "slip"];
const slider = (name, attributes, oninput) => {
  const input = make("input", { type: "range", ...attributes });
  input.addEventListener("input", () => oninput(Number(input.value)));
  return [make("label", {}, name + " ", input), input];
};

// The body at phase `t` of its period: places and the size of the displacement from 0 to 1.
function movedBody(motion, state, t, amplitude) {
  const { positions, dimension } = motion, count = positions.length / dimension;
  const places = Float64Array.from(positions), sizes = new Float64Array(count);
  if (state.parts) return { places, sizes };
  const scale = (0.07 * amplitude * motion.half) / state.largest;
  const [cos, sin] = [Math.cos(2 * Math.PI * t), Math.sin(2 * Math.PI * t)];
  const turn = (state.turn ?? 0) * t, [turnCos, turnSin] = [Math.cos(turn), Math.sin(turn)];
  for (let i = 0; i < count; i++) {
    let square = 0;
    for (let k = dimension * i; k < dimension * (i + 1); k++) {
      const part = state.displacement ? state.displacement[k] : state.real[k] * cos - state.imaginary[k] * sin;
      places[k] += scale * part;
      square += part * part;
    }
    const [x, y] = [places[dimension * i], places[dimension * i + 1]];
    places[dimension * i] = turnCos * x - turnSin * y;
    places[dimension * i + 1] = turnSin * x + turnCos * y;
    sizes[i] = Math.sqrt(square) / state.largest;
  }
  return { places, sizes };
}
// Middle and half the size of a body, and the largest displacement of each of its motions.
function measure(motion) {
  const { positions, dimension } = motion;
  const low = Array(dimension).fill(Infinity), high = Array(dimension).fill(-Infinity);
  positions.forEach((v, i) => ((low[i % dimension] = Math.min(low[i % dimension], v)), (high[i % dimension] = Math.max(high[i % dimension], v))));
  motion.half = 0.5 * Math.max(...high.map((v, k) => v - low[k]));
  motion.middle = low.map((v, k) => 0.5 * (v + high[k]));
  for (const state of motion.states.filter((state) => !state.parts)) {
    const parts = state.displacement ? [state.displacement] : [state.real, state.imaginary];
    state.largest = 1e-300;
    for (let i = 0; i < positions.length; i += dimension) {
      let square = 0;
      for (const part of parts) for (let k = i; k < i + dimension; k++) square += part[k] * part[k];
      state.largest = Math.max(state.largest, Math.sqrt(square));
    }
  }
}
// A plane body on a canvas.
function planePicture(motion, width, height) {
  const canvas = make("canvas", { width, height, role: "img" });
  const context = canvas.getContext("2d"), half = 0.5 * width, zoom = half / (1.16 * motion.half);
  const at = (places, node) => [half + zoom * (places[2 * node] - motion.middle[0]), half - zoom * (places[2 * node + 1] - motion.middle[1])];
  const paint = (state, places, sizes) => {
    const paths = ramp.map(() => new Path2D());
    let start = 0;
    for (const size of motion.sizes) {
      let sum = 0;
      for (let k = 0; k < size; k++) sum += sizes[motion.cells[start + k]];
      const path = paths[Math.min(9, Math.floor((10 * sum) / size))];
      for (let k = 0; k < size; k++) path[k ? "lineTo" : "moveTo"](...at(places, motion.cells[start + k]));
      path.closePath();
      start += size;
    }
    context.clearRect(0, 0, width, height);
    paths.forEach((path, level) => {
      context.fillStyle = context.strokeStyle = ramp[level];
      context.lineWidth = 0.6;
      context.fill(path);
      context.stroke(path);
    });
    if (state.status) {
      context.lineWidth = 7;
      motion.edge.forEach((node, i) => {
        context.strokeStyle = statusColours[state.status[i]];
        context.beginPath();
        context.moveTo(...at(places, node));
        context.lineTo(...at(places, motion.edge[(i + 1) % motion.edge.length]));
        context.stroke();
      });
    }
  };
  return { canvas, paint, look: {}, tools: [], hint: "" };
}
const isMoving = (motion) => motion.states.some((state) => !state.parts);
function animate(motion, holder) {
  measure(motion);
  const picture = motion.dimension === 3 ? solidPicture(motion, 720, 560) : planePicture(motion, 640, 640);
  const { canvas } = picture, isAnimated = isMoving(motion);
  let state = motion.states[0], t = 0, speed = 0.5, amplitude = 1, timer = 0, before;
  const draw = () => {
    const { places, sizes } = movedBody(motion, state, t, amplitude);
    picture.paint(state, places, sizes);
    canvas.dataset.phase = t.toFixed(4);
  };
  picture.look.redraw = () => timer || draw();
  const frame = (now) => {
    t = (t + (speed * Math.min(100, now - (before ?? now))) / 1000) % 1e6;
    before = now;
    draw();
    timer = requestAnimationFrame(frame);
  };
  const play = button("Play", () => {
    timer ? (cancelAnimationFrame(timer), (timer = 0)) : ((before = undefined), (timer = requestAnimationFrame(frame)));
    play.textContent = timer ? "Pause" : "Play";
  });
  const legend = make("span", { class: "tools" });
  const key = ([colour, word]) => {
    const mark = make("span", { class: "key line" });
    mark.style.color = colour;
    return make("span", {}, mark, word);
  };
  const show = () => {
    canvas.setAttribute("aria-label", `${isAnimated ? "The moving body" : "The body"}: ${state.name}${picture.hint}`);
    const statuses = state.status ? statusNames.map((word, code) => [statusColours[code], word]) : [];
    legend.replaceChildren(...[...(state.parts ?? []), ...statuses].filter((part) => part[1]).map(key));
    draw();
  };
  const choice = make("select", {}, ...motion.states.map((state, i) => make("option", { value: i }, state.name)));
  choice.addEventListener("change", () => ((state = motion.states[choice.value]), show()));
  const [speedLabel] = slider("Periods a second", { min: 0.05, max: 3, step: 0.05, value: speed }, (value) => (speed = value));
  const [sizeLabel] = slider("Amplitude", { min: 0, max: 3, step: 0.05, value: 1 }, (value) => ((amplitude = value), draw()));
  const moving = isAnimated ? [play, speedLabel, sizeLabel] : [];
  holder.append(canvas, make("div", { class: "tools" }, make("label", {}, isAnimated ? "Motion " : "Colours ", choice), ...moving, ...picture.tools, legend));
  show();
}

// A parameter: its points over the curves of the first panel, and a list of those that matter.
function stepThrough(steps, panel, holder) {
  let at = 0;
  const draw = (u) => steps.marks[at].forEach(([x, y, , isListed]) => {
    u.ctx.beginPath();
    u.ctx.arc(u.valToPos(x, "x", true), u.valToPos(y, "y", true), (isListed ? 6 : 4) * devicePixelRatio, 0, 7);
    u.ctx.fillStyle = isListed ? "#d55e00" : "#0072b2";
    u.ctx.fill();
  });
  const place = make("div"), list = make("ul"), head = make("p", { "aria-live": "polite" });
  holder.append(place);
  const u = plotPanel(panel, place, { overlay: { draw } });
  const show = (value) => {
    at = value;
    const listed = steps.marks[at].filter((mark) => mark[3]);
    const text = `${steps.quantity} = ${digits(steps.values[at])}`;
    input.setAttribute("aria-valuetext", text);
    head.textContent = `${text}: ${listed.length || "no"} unstable`;
    list.replaceChildren(...listed.map((mark) => make("li", {}, mark[2])));
    u.redraw(false);
  };
  const [label, input] = slider(steps.quantity, { min: 0, max: steps.values.length - 1, step: 1, value: 0 }, show);
  holder.append(make("div", { class: "tools" }, label), head, list);
  show(0);
}

// Sound: the signal at 48 kHz, low-passed, played `slow` times slower; or its end repeated.
const rate = 48000;
function samplesOf(values, interval, slow) {
  const step = 1 / (rate * slow * interval), reach = 8 * Math.max(1, step);
  const mean = values.reduce((sum, v) => sum + v, 0) / values.length;
  return Float64Array.from({ length: Math.max(1, Math.floor(values.length / step)) }, (_, k) => {
    let [sum, total] = [0, 0];
    for (let i = Math.max(0, Math.ceil(k * step - reach)); i <= Math.min(values.length - 1, k * step + reach); i++) {
      const x = (i - k * step) / Math.max(1, step), arc = Math.PI * x;
      const weight = (x ? Math.sin(arc) / arc : 1) * Math.cos((Math.PI * x) / 16) ** 2;
      sum += weight * (values[i] - mean);
      total += weight;
    }
    return sum / total;
  });
}
function wavOf(samples) {
  const peak = samples.reduce((most, v) => Math.max(most, Math.abs(v)), 1e-300), fade = Math.min(240, samples.length / 2);
  const view = new DataView(new ArrayBuffer(44 + 2 * samples.length));
  const text = (at, word) => [...word].forEach((letter, i) => view.setUint8(at + i, letter.charCodeAt(0)));
  text(0, "RIFF"), view.setUint32(4, 36 + 2 * samples.length, true), text(8, "WAVEfmt ");
  view.setUint32(16, 16, true), view.setUint16(20, 1, true), view.setUint16(22, 1, true);
  view.setUint32(24, rate, true), view.setUint32(28, 2 * rate, true), view.setUint16(32, 2, true), view.setUint16(34, 16, true);
  text(36, "data"), view.setUint32(40, 2 * samples.length, true);
  samples.forEach((v, i) => view.setInt16(44 + 2 * i, Math.round((26000 * v * Math.min(1, i / fade, (samples.length - 1 - i) / fade)) / peak), true));
  return view.buffer;
}
function base64Of(buffer) {
  const bytes = new Uint8Array(buffer), parts = [];
  for (let at = 0; at < bytes.length; at += 8192) parts.push(String.fromCharCode(...bytes.subarray(at, at + 8192)));
  return btoa(parts.join(""));
}
// The strongest line between 0.1 and 45 kHz of the last samples, in Hz.
function toneOf(values, interval) {
  const count = Math.min(values.length, 8192), end = values.slice(-count);
  const mean = end.reduce((sum, v) => sum + v, 0) / count;
  const weighted = end.map((v, i) => (v - mean) * Math.sin((Math.PI * (i + 0.5)) / count) ** 2);
  const lines = [0];
  for (let line = 1; line < count / 2 && line <= 45000 * count * interval; line++) {
    const [cos, sin] = [Math.cos((2 * Math.PI * line) / count), Math.sin((2 * Math.PI * line) / count)];
    let [re, im, c, s] = [0, 0, 1, 0];
    for (const v of weighted) {
      re += v * c;
      im += v * s;
      [c, s] = [c * cos - s * sin, s * cos + c * sin];
    }
    lines.push(Math.hypot(re, im));
  }
  let best = 0;
  lines.forEach((size, line) => line >= 100 * count * interval && size > lines[best] && (best = line));
  if (!best || !(lines[best] > 0)) return 0;
  // Between the lines by the parabola through three of them, in logarithms.
  const [low, middle, high] = [-1, 0, 1].map((by) => Math.log(lines[best + by] || lines[best] * 1e-9));
  const shift = (low - high) / (2 * (low - 2 * middle + high)) || 0;
  return (best + shift) / (count * interval);
}
function listen(signals, holder) {
  let audio;
  const source = make("select", {}, ...signals.map((signal, i) => make("option", { value: i }, signal.name)));
  const part = make("select", {}, make("option", { value: "end" }, "last fifth, repeated for 2 s"), make("option", { value: "all" }, "whole run, once"));
  const slow = make("select", {}, make("option", { value: 0 }, "as fast as audible"), ...[1, 2, 5, 10, 20, 50, 100].map((k) => make("option", { value: k }, k === 1 ? "as it is" : `${k} times slower`)));
  const text = make("output");
  const play = () => {
    const { values, interval } = signals[source.value];
    const end = values.slice(-Math.ceil(values.length / 5)), hertz = toneOf(end, interval);
    const factor = Number(slow.value) || [1, 2, 5, 10, 20, 50].find((k) => hertz / k <= 16000) || 100;
    // A whole number of periods joins without a click.
    const period = 1 / (hertz * interval), periods = Math.floor(end.length / period);
    const isEnd = part.value === "end" && periods > 0 && Number.isFinite(period);
    let samples = samplesOf(isEnd ? end.slice(-Math.round(periods * period)) : values, interval, factor);
    if (isEnd) samples = Float64Array.from({ length: 2 * rate }, (_, i) => samples[i % samples.length]);
    audio?.remove();
    // A page that was opened as a file may not play blobs.
    audio = make("audio", { controls: true, src: `data:audio/wav;base64,${base64Of(wavOf(samples))}` });
    text.textContent = `${hertz ? `loudest at ${digits(hertz / 1000, 4)} kHz` : "no tone"}, ${factor === 1 ? "at its own pitch" : `slowed ${factor} times: heard at ${digits(hertz / 1000 / factor, 4)} kHz`}; ${digits(samples.length / rate, 3)} s.`;
    text.after(audio);
    audio.play().catch(() => {});
  };
  holder.append(make("div", { class: "tools" }, make("label", {}, "Signal ", source), make("label", {}, "Part ", part), make("label", {}, "Speed ", slow), button("Play sound", play)), text);
}

// Everything in its place.
const signalsOf = (figure) => figure.panels.flatMap((panel) => panel.series
  .filter((series) => series.kind === "line" && (series.heard || series.isWhole) && series.xs.length > 1000 && /^time/.test(panel.x.title))
  .map((series) => {
    const unit = { s: 1, ms: 1e-3, "µs": 1e-6 }[/\(([^)]*)\)/.exec(panel.x.title)?.[1]] ?? 1;
    // Of a long record the end is kept sample by sample.
    const length = unit * (series.xs.at(-1) - series.xs[0]), count = series.heard ? series.of : series.xs.length;
    return { name: series.name || panel.caption || panel.y.title, values: series.heard ?? series.ys, interval: length / (count - 1) };
  }));
function equipFigure(figure) {
  const place = document.getElementById(figure.name);
  const tools = make("div", { class: "tools figure-tools" });
  const more = (text, fill) => {
    const holder = make("div", { class: "more", hidden: true });
    let isFilled = false;
    const toggle = button(text, () => {
      holder.hidden = !holder.hidden;
      toggle.setAttribute("aria-expanded", !holder.hidden);
      if (!isFilled) fill(holder);
      isFilled = true;
    }, { "aria-expanded": false });
    tools.append(toggle);
    place.append(holder);
  };
  place?.append(tools);
  if (!place) return;
  const plots = figure.panels.filter((panel) => panel.series.some((series) => series.kind !== "field"));
  const row = (holder) => (number) => {
    const table = [...document.querySelectorAll("table")].find((table) => table.tHead?.rows[0].cells[0].textContent === "point");
    const found = [...(table?.tBodies[0].rows ?? [])].find((row) => row.cells[0].textContent === String(number));
    const pairs = found ? [...found.cells].map((cell, i) => make("div", {}, make("dt", {}, table.tHead.rows[0].cells[i].textContent), make("dd", {}, cell.textContent))) : [];
    holder.replaceChildren(...pairs);
  };
  if (plots.length) more("Zoom and read", (holder) => {
    const details = make("dl", { "aria-live": "polite", class: "picked" });
    plots.forEach((panel) => {
      if (panel.caption) holder.append(make("p", { class: "caption" }, panel.caption));
      plotPanel(panel, holder, { pick: row(details) });
    });
    holder.append(details);
  });
  if (figure.steps) more(`Move ${figure.steps.quantity}`, (holder) => stepThrough(figure.steps, figure.panels[0], holder));
  if (figure.motion) more(isMoving(figure.motion) ? "Animate" : "Look around", (holder) => animate(figure.motion, holder));
  const signals = signalsOf(figure);
  if (signals.length) more("Listen", (holder) => listen(signals, holder));
  if (figure.panels.some((panel) => panel.series.length)) {
    const note = make("output");
    const series = figure.panels.flatMap((panel) => panel.series), left = series.filter((s) => s.of > s.xs.length);
    tools.append(button("Data (CSV)", () => {
      download(figure.name + ".csv", "text/csv", csvOf(figure));
      if (left.length) note.textContent = `${left.length} of ${series.length} curves thinned with their extremes kept; the tables of the run have every sample.`;
    }), note);
  }
}
document.querySelectorAll("main section:not(#manifest) table").forEach(equipTable);
(async () => {
  const { arrays, figures, library } = JSON.parse(document.getElementById("data").textContent);
  const numbers = await unpack(arrays, document.getElementById("block").textContent);
  document.head.append(make("script", {}, numbers[library][0]));
  for (const figure of figures) {
    for (const { series } of figure.panels) for (const one of series) {
      Object.assign(one, { xs: numbers[one.x], ys: numbers[one.y], values: numbers[one.value], heard: numbers[one.heard], tips: numbers[one.tips] });
      one.isSorted = one.xs.every((v, i) => !i || one.xs[i - 1] <= v);
      one.isWhole = one.even || one.of === one.xs.length;
    }
    const { motion, steps } = figure;
    if (steps) {
      const { counts, x, y, listed, names } = Object.fromEntries(["counts", "x", "y", "listed", "names"].map((key) => [key, numbers[steps[key]]]));
      let at = 0, name = 0;
      const mark = () => [x[at], y[at], listed[at] ? names[name++] : "", listed[at++] === 1];
      steps.marks = Array.from(counts, (length) => Array.from({ length }, mark));
    }
    if (motion) {
      for (const key of ["positions", "sizes", "cells", "edge", "lines"]) motion[key] = numbers[motion[key]];
      for (const state of motion.states) for (const key of ["real", "imaginary", "displacement", "status", "partOf"]) if (key in state) state[key] = numbers[state[key]];
    }
    equipFigure(figure);
  }
  document.documentElement.dataset.ready = "yes";
})();
