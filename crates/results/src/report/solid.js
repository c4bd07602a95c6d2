// A solid body on a canvas, from a point of view that the reader turns: triangles in a depth buffer, hidden parts hidden.
const ramp = ["#440154", "#482878", "#3e4989", "#31688e", "#26828e", "#1f9e89", "#35b779", "#6ece58", "#b5de2b", "#fde725"];
const channelsOf = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
const light = [-0.35, 0.5, 0.79], edgeColour = [48, 48, 48];
const unit = (v) => v.map((x) => x / (Math.hypot(...v) || 1));
const cross = (a, b) => [0, 1, 2].map((k) => a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
// A vector turned by an angle about a unit vector (Rodrigues).
const turned = (v, axis, angle) => {
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)], along = dot(axis, v), across = cross(axis, v);
  return v.map((x, k) => x * cos + across[k] * sin + axis[k] * along * (1 - cos));
};
// From the front, the right and above, z upwards.
const firstView = () => {
  const towards = unit([0.5, -0.72, 0.62]), right = unit(cross([0, 0, 1], towards));
  return [right, cross(towards, right), towards];
};
// Triangles of rings of corners, and the cell of each.
function trianglesOf({ sizes, cells }) {
  const corners = [], cellOf = [];
  let start = 0;
  sizes.forEach((size, cell) => {
    for (let k = 2; k < size; k++) corners.push(cells[start], cells[start + k - 1], cells[start + k]), cellOf.push(cell);
    start += size;
  });
  return { corners: Uint32Array.from(corners), cellOf };
}
function solidPicture(motion, width, height) {
  const canvas = make("canvas", { width, height, role: "img", tabindex: 0 });
  const context = canvas.getContext("2d"), image = context.createImageData(width, height);
  const pixels = new Uint32Array(image.data.buffer), depths = new Float32Array(width * height);
  const { corners, cellOf } = trianglesOf(motion), count = motion.positions.length / 3;
  const seen = new Float32Array(3 * count);
  // Colours by level, finer than the ramp's.
  const levels = Array.from({ length: 64 }, (_, level) => {
    const at = (level / 63) * (ramp.length - 1), low = Math.min(ramp.length - 2, Math.floor(at));
    const [a, b] = [channelsOf(ramp[low]), channelsOf(ramp[low + 1])];
    return a.map((x, k) => x + (at - low) * (b[k] - x));
  });
  const packed = ([r, g, b], shade) => 0xff000000 | ((b * shade) << 16) | ((g * shade) << 8) | (r * shade);
  let view = firstView(), zoom = 1;
  // Pixels to the right and down, and the depth towards the viewer, of every node.
  const project = (places) => {
    const scale = (zoom * 0.46 * Math.min(width, height)) / motion.half;
    for (let node = 0; node < count; node++) {
      const place = [0, 1, 2].map((k) => scale * (places[3 * node + k] - motion.middle[k]));
      seen[3 * node] = 0.5 * width + dot(view[0], place);
      seen[3 * node + 1] = 0.5 * height - dot(view[1], place);
      seen[3 * node + 2] = dot(view[2], place);
    }
  };
  const fill = (a, b, c, colourAt) => {
    const [ax, ay, az, bx, by, bz, cx, cy, cz] = [a, b, c].flatMap((node) => [seen[3 * node], seen[3 * node + 1], seen[3 * node + 2]]);
    const area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
    if (!area) return;
    const normal = unit(cross([bx - ax, ay - by, bz - az], [cx - ax, ay - cy, cz - az]));
    const shade = 0.42 + 0.58 * Math.max(0, Math.min(1, dot(normal, light) * Math.sign(normal[2])));
    const rows = [Math.max(0, Math.ceil(Math.min(ay, by, cy))), Math.min(height - 1, Math.floor(Math.max(ay, by, cy)))];
    const columns = [Math.max(0, Math.ceil(Math.min(ax, bx, cx))), Math.min(width - 1, Math.floor(Math.max(ax, bx, cx)))];
    for (let y = rows[0]; y <= rows[1]; y++)
      for (let x = columns[0]; x <= columns[1]; x++) {
        const v = ((x - ax) * (cy - ay) - (cx - ax) * (y - ay)) / area, w = ((bx - ax) * (y - ay) - (x - ax) * (by - ay)) / area;
        if (v < -1e-6 || w < -1e-6 || v + w > 1.000001) continue;
        const depth = az + v * (bz - az) + w * (cz - az), pixel = y * width + x;
        if (depth <= depths[pixel]) continue;
        depths[pixel] = depth;
        pixels[pixel] = packed(colourAt(v, w), shade);
      }
  };
  // An edge lies a little before the faces that it bounds.
  const stroke = (a, b) => {
    const [from, to] = [a, b].map((node) => [0, 1, 2].map((k) => seen[3 * node + k]));
    const steps = Math.ceil(Math.max(Math.abs(to[0] - from[0]), Math.abs(to[1] - from[1]), 1));
    for (let step = 0; step <= steps; step++) {
      const [x, y, z] = from.map((value, k) => value + (step / steps) * (to[k] - value));
      const [column, row] = [Math.round(x), Math.round(y)];
      if (column < 0 || row < 0 || column >= width || row >= height) continue;
      const pixel = row * width + column;
      if (z + 1.5 >= depths[pixel]) pixels[pixel] = packed(edgeColour, 1);
    }
  };
  const paint = (state, places, sizes) => {
    project(places);
    pixels.fill(0);
    depths.fill(-Infinity);
    const colours = state.parts?.map(([colour]) => channelsOf(colour));
    for (let k = 0; k < cellOf.length; k++) {
      const [a, b, c] = [corners[3 * k], corners[3 * k + 1], corners[3 * k + 2]];
      const level = (v, w) => levels[Math.min(63, Math.floor(64 * (sizes[a] + v * (sizes[b] - sizes[a]) + w * (sizes[c] - sizes[a]))))];
      const part = colours?.[state.partOf[cellOf[k]]];
      fill(a, b, c, part ? () => part : level);
    }
    for (let k = 0; k < motion.lines.length; k += 2) stroke(motion.lines[k], motion.lines[k + 1]);
    context.putImageData(image, 0, 0);
  };
  // Drag and arrow keys turn, plus and minus zoom, 0 is the first view.
  const look = { redraw: () => {} };
  const rotate = (across, up) => {
    view = view.map((axis) => turned(axis, view[1], -across));
    view = view.map((axis) => turned(axis, view[0], -up));
    canvas.dataset.view = view[2].map((x) => x.toFixed(3)).join(" ");
    look.redraw();
  };
  const zoomBy = (factor) => ((zoom = Math.min(40, Math.max(0.2, zoom * factor))), look.redraw());
  let held;
  canvas.addEventListener("pointerdown", (event) => ((held = [event.clientX, event.clientY]), canvas.setPointerCapture(event.pointerId)));
  canvas.addEventListener("pointermove", (event) => {
    if (!held) return;
    rotate((event.clientX - held[0]) / 150, (event.clientY - held[1]) / 150);
    held = [event.clientX, event.clientY];
  });
  for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, () => (held = undefined));
  const keys = { ArrowLeft: () => rotate(-0.2, 0), ArrowRight: () => rotate(0.2, 0), ArrowUp: () => rotate(0, -0.2), ArrowDown: () => rotate(0, 0.2), "+": () => zoomBy(1.25), "=": () => zoomBy(1.25), "-": () => zoomBy(0.8), 0: () => ((view = firstView()), (zoom = 1), rotate(0, 0)) };
  canvas.addEventListener("keydown", (event) => {
    if (!keys[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    keys[event.key]();
  });
  const tools = [button("Zoom in", keys["+"]), button("Zoom out", keys["-"]), button("First view", keys[0])];
  return { canvas, paint, look, tools, hint: ". Drag or arrow keys turn it, plus and minus zoom, 0 goes back." };
}
