// --- page.js: puts everything together. One number is shown by all parts: the index of a step in the series.

const byId = id => document.getElementById(id);
const summary = run.summary;
const instrument = summary.instruments[0];
const loads = frames.flatMap(frame => Array.from(frame.force)).filter(force => force > 0);
// The colours end where one in two hundred of the loaded points has more: a single spike must not hide the others.
const most_force = roundUp(percentile(loads, 0.995));

let shown = -1;
let axis = "inserted_mm";
let view = "front";
let playing = 0;

// --- words and numbers

function fillHead() {
  byId("title").textContent = run.title;
  byId("subtitle").textContent = run.subtitle;
  document.title = run.title;
  const badge = (text, tone) => byId("badges").append(element("li", tone, text));
  if (summary.target) {
    const name = summary.target.name || "branch " + summary.target.branch;
    badge(summary.target.reached ? `${name} reached` : `${name} missed, ${digits(summary.target.to_go_mm)}${thin}mm to go`,
          summary.target.reached ? "good" : "bad");
  }
  badge(summary.converged_steps === summary.steps ? `${summary.steps} steps, all converged`
                                                   : `${summary.steps - summary.converged_steps} of ${summary.steps} steps did not converge`,
        summary.converged_steps === summary.steps ? "good" : "bad");
  if (summary.wall_crossings === null) badge("crossings not judged", "calm");
  else badge(summary.wall_crossings === 1 ? "1 wall crossing" : `${summary.wall_crossings} wall crossings`,
             summary.wall_crossings === 0 ? "good" : "bad");
}

function fillNumbers() {
  const number = (label, value, unit) => {
    const box = element("div");
    const dd = element("dd", "", value);
    if (unit) dd.append(element("small", "", thin + unit));
    box.append(element("dt", "", label), dd);
    byId("numbers").append(box);
  };
  number("Inserted", fixed(instrument.inserted_length_mm, 1), "mm");
  number("Tip in branch", instrument.tip_branch === null ? "\u2013" : instrument.tip_branch);
  number("Largest push", digits(instrument.max_push_force_n), "N");
  number("Largest torque", digits(instrument.max_torque_n_mm), "N\u00b7mm");
  number("Largest wall force in 5 mm", digits(summary.max_force_5mm_n), "N");
  number("Largest tip force", digits(summary.max_tip_force_n), `of ${digits(summary.perforation_threshold.force_n)} N`);
}

function fillRows() {
  const rows = (id, list) => list.forEach(([label, value]) =>
    byId(id).append(element("dt", "", label), element("dd", "", value)));
  const us = value => Number.isFinite(value) ? (value >= 1000 ? digits(value / 1000) + thin + "ms" : digits(value) + thin + "\u00b5s") : "\u2013";
  const { machine } = summary;
  rows("speed", [
    ["Step, median", us(machine.step_time_us.p50)],
    ["Step, 99 %", us(machine.step_time_us.p99)],
    ["Step, longest", us(machine.step_time_us.max)],
    [`Step with a snap (${machine.step_time_snap_us.steps}), median`, machine.step_time_snap_us.steps ? us(machine.step_time_snap_us.p50) : "\u2013"],
    ["Preparation", withUnit(digits(machine.preparation_s), "s") + (machine.field_from_cache ? ", from the cache" : "")],
    ["Memory", withUnit(fixed(machine.peak_memory_mb, 0), "MB")],
  ]);
  const { vessel } = summary;
  rows("facts", [
    ["Triangles", vessel.triangles.toLocaleString("en")],
    ["Lumen diameter, median", withUnit(digits(vessel.lumen_diameter_mm.p50), "mm")],
    ["Error of the distance field", withUnit(digits(vessel.field.error_max_mm), "mm at most")],
    ["Rods", summary.rods.min === summary.rods.max ? summary.rods.max : `${summary.rods.min} to ${summary.rods.max}`],
    ["Newton iterations a step", `${digits(summary.newton_iterations.mean)}, at most ${summary.newton_iterations.max}`],
    ["Detections a step", digits(summary.detections_per_step)],
    ["Wall gives way by", withUnit(digits(summary.max_wall_deflection_mm), "mm at most")],
    ["State", summary.state_hash],
  ]);
  const drawn = run.vessel.triangles === run.vessel.triangles_of_mesh ? ""
    : run.vessel.triangles === 0 ? " The vessel is not drawn: this build cannot make a mesh of its size smaller."
    : ` The vessel is drawn with ${run.vessel.triangles.toLocaleString("en")} of its triangles.`;
  const kept = run.series.every === 1 ? "" : ` Of ${run.series.every} steps the one that presses the wall most is charted.`;
  byId("note").textContent = `${frames.length} shapes of the wire.${kept}${drawn} endowire ${run.version}. Not a medical device.`;
}

function fillEvents() {
  for (const event of events) {
    const row = element("li", event.tone);
    const button = element("button");
    button.type = "button";
    button.append(element("i"), element("span", "", event.label),
                  element("b", "", event.figure),
                  element("time", "", fixed(event.time_s, 1) + thin + "s"));
    button.addEventListener("click", () => show(event.at));
    row.append(button);
    byId("events").append(row);
  }
  if (!events.length) byId("events").append(element("li", "none", "None."));
  const more = summary.events_in_all - events.length;
  if (more > 0) byId("events").append(element("li", "none", `and ${more} more, in summary.json`));
}

function fillLegend() {
  byId("ramp-ticks").replaceChildren(...[0, 0.1, 0.4, 1].map(part => {
    const tick = element("span", "", (part === 1 ? "\u2265" + thin : "") + Number((part * most_force).toPrecision(2)));
    tick.style.left = 100 * Math.sqrt(part) + "%";  // the square root of the force runs evenly along the colours
    return tick;
  }));
}

// --- the picture

let scene = null;

function colours() {
  const style = getComputedStyle(document.documentElement);
  const of = name => style.getPropertyValue("--" + name).trim();
  return { stage: of("stage"), lens: of("lens"), glass: of("glass"), wire: of("wire"), sheath: of("sheath") };
}

function startScene() {
  try {
    scene = new Scene(byId("view"), most_force);
  } catch (error) {
    byId("trouble").hidden = false;
    byId("trouble").textContent = error.message + " The charts below work without it.";
    document.documentElement.dataset.picture = "none";
  }
}

function lensBox() {
  const lens = byId("lens").getBoundingClientRect();
  const canvas = byId("view").getBoundingClientRect();
  if (view === "tip" || lens.width === 0) return null;
  return { left: lens.left - canvas.left, bottom: canvas.bottom - lens.bottom, size: lens.width };
}

let drawing = false;
function redraw() {
  if (!scene || drawing) return;
  drawing = true;
  requestAnimationFrame(() => {
    drawing = false;
    drawNow();
  });
}

function drawNow() {
  scene.draw(lensBox());
  drawOverlay();
}

function drawOverlay() {
  const { clientWidth: width, clientHeight: height } = byId("view");
  const labels = byId("labels");
  labels.replaceChildren();
  const label = (text, point, className) => {
    const [x, y] = scene.camera.project(point);
    const left = width / 2 + x, top = height / 2 + y;
    if (left < 0 || left > width || top < 0 || top > height) return;
    const mark = element("span", className + (left > width - 90 ? " left" : ""), text);
    mark.style.left = left + "px";
    mark.style.top = top + "px";
    labels.append(mark);
  };
  if (summary.target) label(summary.target.name || "target", summary.target.position_mm, "target");
  label("access", run.access.position_mm, "access");
  if (scene.frame) label("tip", scene.tip(), "tip");
  const per_mm = scene.camera.pixels_per_mm;
  const bar = [500, 200, 100, 50, 20, 10, 5, 2, 1, 0.5, 0.2, 0.1].find(mm => mm * per_mm <= 110) || 0.1;
  byId("scale-bar").style.width = bar * per_mm + "px";
  byId("scale-text").textContent = bar + thin + "mm";
  byId("lens").hidden = view === "tip" || !scene.frame;
  byId("lens-scale").textContent = lens_mm + thin + "mm wide";
}

function setView(name) {
  view = name;
  for (const button of document.querySelectorAll("[data-view]"))
    button.setAttribute("aria-pressed", button.dataset.view === name);
  if (!scene) return;
  scene.room = byId("view").clientWidth < 560 ? { top: 58, bottom: 88 } : { top: 24, bottom: 24 };
  scene.home(name === "side" ? Math.PI / 2 : 0);
  if (name === "tip") {
    scene.camera.pixels_per_mm = Math.min(byId("view").clientWidth, byId("view").clientHeight) / 60;
    scene.camera.centre = scene.tip();
  }
  redraw();
}

function handleCanvas() {
  const canvas = byId("view");
  const held = new Map();
  let pinch = 0;
  const move = (dx, dy) => {
    const [right, up] = scene.camera.axes();
    scene.camera.centre = add(scene.camera.centre, add(times(-dx / scene.camera.pixels_per_mm, right),
                                                       times(dy / scene.camera.pixels_per_mm, up)));
  };
  /** So that the point under the fingers stays there. */
  const zoom = (factor, x, y) => {
    const box = canvas.getBoundingClientRect();
    const dx = x - box.left - box.width / 2, dy = y - box.top - box.height / 2;
    move(-dx, -dy);
    scene.camera.pixels_per_mm = Math.min(400, Math.max(0.05, scene.camera.pixels_per_mm * factor));
    move(dx, dy);
  };
  canvas.addEventListener("pointerdown", event => {
    canvas.setPointerCapture(event.pointerId);
    held.set(event.pointerId, event);
    pinch = 0;
  });
  for (const end of ["pointerup", "pointercancel"])
    canvas.addEventListener(end, event => held.delete(event.pointerId));
  canvas.addEventListener("pointermove", event => {
    const before = held.get(event.pointerId);
    if (!before) return;
    const dx = event.clientX - before.clientX, dy = event.clientY - before.clientY;
    held.set(event.pointerId, event);
    if (held.size === 2) {
      const [a, b] = held.values();
      const apart = Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
      if (pinch) zoom(apart / pinch, (a.clientX + b.clientX) / 2, (a.clientY + b.clientY) / 2);
      pinch = apart;
      move(dx / 2, dy / 2);
    } else if (event.shiftKey || event.buttons === 2 || event.buttons === 4) {
      move(dx, dy);
    } else {
      scene.camera.yaw += 0.008 * dx;
      scene.camera.pitch = Math.max(-1.5, Math.min(1.5, scene.camera.pitch - 0.008 * dy));
    }
    redraw();
  });
  canvas.addEventListener("wheel", event => {
    event.preventDefault();
    zoom(Math.exp(-0.0015 * event.deltaY), event.clientX, event.clientY);
    redraw();
  }, { passive: false });
  canvas.addEventListener("contextmenu", event => event.preventDefault());
  canvas.addEventListener("dblclick", () => setView(view));
}

// --- time

const charts = [
  ["Push at the hand", "N", [{ values: series.push_force_n, className: "main" }]],
  ["Torque at the hand", "N\u00b7mm", [{ values: series.torque_n_mm, className: "main" }]],
  ["Largest wall force in 5 mm, and at the tip", "N",
   [{ values: series.wall_force_n, className: "main" }, { values: series.tip_force_n, className: "quiet" }]],
].map(([label, unit, lines], i, all) =>
  new Chart(byId("charts"), { label, unit, lines, axis_below: i === all.length - 1, seek: i => show(i) }));
const timeline = series.count ? new Timeline(byId("timeline")) : null;

function setAxis(name) {
  axis = name;
  for (const button of document.querySelectorAll("[data-axis]"))
    button.setAttribute("aria-pressed", button.dataset.axis === name);
  for (const chart of charts) {
    chart.layout(axis);
    if (shown >= 0) chart.show(shown);
  }
}

function show(i) {
  i = Math.max(0, Math.min(series.count - 1, Math.round(i)));
  if (i === shown || series.count === 0) return;
  shown = i;
  byId("scrub").value = i;
  byId("scrub").setAttribute("aria-valuetext", `step ${series.step[i]}, ${fixed(series.time_s[i], 1)} seconds`);
  byId("scrub").style.setProperty("--at", i / Math.max(1, series.count - 1));
  byId("when").replaceChildren(element("b", "", fixed(series.time_s[i], 1) + thin + "s"),
                               element("span", "", `step ${series.step[i]}`),
                               element("span", "", fixed(series.inserted_mm[i], 1) + thin + "mm in"));
  for (const chart of charts) chart.show(i);
  if (timeline) timeline.show(i);
  events.forEach((event, k) => byId("events").children[k].classList.toggle("past", event.at <= i));
  if (!scene) return;
  const frame = frames.length && frames[0].step <= series.step[i]
    ? frames[lastNotAbove(frames, series.step[i], f => f.step)] : null;
  if (frame !== scene.frame) scene.show(frame);
  if (view === "tip") scene.camera.centre = scene.tip();
  redraw();
}

/** The whole run in its own time, but in no more than 15 seconds. */
function play(on) {
  cancelAnimationFrame(playing);
  playing = 0;
  byId("play").classList.toggle("on", on);
  if (!on || series.count < 2) return;
  const total_s = series.time_s[series.count - 1];
  const speed = Math.max(1, total_s / 15);
  let time_s = shown >= series.count - 1 ? 0 : series.time_s[Math.max(0, shown)];
  let before = performance.now();
  const tick = now => {
    time_s += speed * (now - before) / 1000;
    before = now;
    show(lastNotAbove(series.time_s, time_s));
    if (time_s >= total_s) return play(false);
    playing = requestAnimationFrame(tick);
  };
  playing = requestAnimationFrame(tick);
}

function handleTime() {
  const scrub = byId("scrub");
  scrub.max = Math.max(0, series.count - 1);
  scrub.addEventListener("input", () => { play(false); show(Number(scrub.value)); });
  byId("play").addEventListener("click", () => play(!playing));
  document.addEventListener("keydown", event => {
    if (event.target.tagName === "BUTTON" || event.ctrlKey || event.metaKey || event.altKey) return;
    const step = { ArrowLeft: -1, ArrowRight: 1, PageUp: -Math.ceil(series.count / 20), PageDown: Math.ceil(series.count / 20) }[event.key];
    if (event.key === " ") play(!playing);
    else if (event.key === "Home") show(0);
    else if (event.key === "End") show(series.count - 1);
    else if (step) show(shown + step);
    else return;
    event.preventDefault();
  });
}

// --- start

function setTheme(name) {
  document.documentElement.dataset.theme = name;
  if (!scene) return;
  scene.paint(colours());
  redraw();
}

/** `#step=120&view=tip&theme=dark`: a link to a state of the page. */
function readHash() {
  const wanted = new URLSearchParams(location.hash.slice(1));
  const dark = window.matchMedia("(prefers-color-scheme: dark)").matches;
  setTheme(wanted.get("theme") || (dark ? "dark" : "light"));
  setAxis(wanted.get("axis") === "time" ? "time_s" : "inserted_mm");
  show(wanted.has("step") ? lastNotAbove(series.step, Number(wanted.get("step"))) : series.count - 1);
  setView(["front", "side", "tip"].includes(wanted.get("view")) ? wanted.get("view") : "front");
  if (scene && wanted.has("check")) {  // for a test without a screen, which gets no animation frames
    drawNow();
    document.documentElement.dataset.drawn = scene.drawnPixels();
  }
}

fillHead();
fillNumbers();
fillRows();
fillEvents();
fillLegend();
startScene();
if (scene) handleCanvas();
handleTime();
for (const button of document.querySelectorAll("[data-view]"))
  button.addEventListener("click", () => setView(button.dataset.view));
for (const button of document.querySelectorAll("[data-axis]"))
  button.addEventListener("click", () => setAxis(button.dataset.axis));
byId("theme").addEventListener("click", () => setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark"));
readHash();
window.addEventListener("resize", () => { setAxis(axis); setView(view); });
window.addEventListener("hashchange", readHash);
document.documentElement.dataset.ready = "true";
