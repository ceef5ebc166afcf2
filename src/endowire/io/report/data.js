// --- data.js: the run as it stands in the page, and how its numbers are written.

const run = JSON.parse(document.getElementById("run").textContent);

/** The bytes of base64 text as an array of that type; every machine with WebGL is little-endian. */
function decode(text, Type) {
  const raw = atob(text);
  const bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; i++) bytes[i] = raw.charCodeAt(i);
  return new Type(bytes.buffer);
}

const series = { count: run.series.count };
for (const name of ["step", "time_s", "inserted_mm", "push_force_n", "torque_n_mm", "wall_force_n", "tip_force_n"])
  series[name] = decode(run.series[name], Float64Array);

/** Shapes of the wire: views into three long arrays. */
const frames = (() => {
  const position = decode(run.wire.position_mm, Float32Array);
  const radius = decode(run.wire.radius_mm, Float32Array);
  const force = decode(run.wire.wall_force_n_per_mm, Float32Array);
  let first = 0;
  return run.wire.step.map((step, i) => {
    const points = run.wire.points[i];
    const frame = {
      step, points,
      position: position.subarray(3 * first, 3 * (first + points)),
      radius: radius.subarray(first, first + points),
      force: force.subarray(first, first + points),
    };
    first += points;
    return frame;
  });
})();

/** Index of the last value that is not above; 0 when all are. Values rise. */
function lastNotAbove(values, value, of = v => v) {
  let low = 0, high = values.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (of(values[middle]) <= value) low = middle + 1; else high = middle;
  }
  return Math.max(0, low - 1);
}

/** The value that a part of all finite ones does not exceed. */
function percentile(values, part) {
  const sorted = Array.from(values).filter(Number.isFinite).sort((a, b) => a - b);
  return sorted.length ? sorted[Math.min(sorted.length - 1, Math.floor(part * sorted.length))] : 0;
}

const minus = "\u2212";
const thin = "\u202f";

/** With so many decimals; a dash for what is no number. */
function fixed(value, decimals) {
  if (!Number.isFinite(value)) return "\u2013";
  const text = Math.abs(value).toFixed(decimals);
  return (value < 0 && Number(text) !== 0 ? minus : "") + text;
}

/** Three digits that count. */
function digits(value) {
  if (!Number.isFinite(value)) return "\u2013";
  if (value === 0) return "0";
  const size = Math.floor(Math.log10(Math.abs(value)));
  return fixed(value, Math.min(6, Math.max(0, 2 - size)));
}

const withUnit = (text, unit) => unit ? text + thin + unit : text;

/** A round number that is at least the value: 1, 2, 2.5, 5, 10, ... */
function roundUp(value) {
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  for (const m of [1, 2, 2.5, 5]) if (m * power >= value * (1 - 1e-9)) return m * power;
  return 10 * power;
}

/** An element with a class and text; text is never read as HTML. */
function element(tag, className, text) {
  const made = document.createElement(tag);
  if (className) made.className = className;
  if (text !== undefined) made.textContent = text;
  return made;
}

