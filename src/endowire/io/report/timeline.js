// --- timeline.js: the whole run below the vessel: how far the wire was in, and where events began.

/** Events in plain words, and how loud they are. */
const event_kinds = {
  snap: ["Snap", "calm"],
  new_branch: ["New branch", "good"],
  stall: ["Stall", "warn"],
  hand_slip: ["Slips in the hand", "warn"],
  exit: ["Left through opening", "warn"],
  too_narrow: ["Lumen narrower than the wire", "bad"],
  kink: ["Kink", "bad"],
  perforation: ["Perforation threshold", "bad"],
  self_overlap: ["Wire lies in itself", "bad"],
  not_converged: ["Not converged", "bad"],
};

const events = run.summary.events.map(event => ({
  ...event,
  label: (event_kinds[event.kind] || [event.kind])[0] + (event.branch ? " " + event.branch : ""),
  figure: event.kind === "exit" ? String(event.value)
    : (event.kind === "new_branch" ? "radius " : "") + withUnit(digits(event.value), event.unit),
  tone: (event_kinds[event.kind] || ["", "calm"])[1],
  at: lastNotAbove(series.step, event.step),
}));

class Timeline {
  constructor(svg) {
    this.svg = svg;
    const { count, inserted_mm } = series;
    const last = Math.max(1, count - 1);
    const most = Math.max(1e-9, ...chunks(inserted_mm, Math.max));
    let path = "M0 40";
    for (let i = 0; i < count; i += Math.max(1, Math.floor(count / 800)))
      path += `L${(1000 * i / last).toFixed(1)} ${(40 - 30 * Math.max(0, inserted_mm[i] || 0) / most).toFixed(1)}`;
    path += `L1000 ${(40 - 30 * Math.max(0, inserted_mm[count - 1] || 0) / most).toFixed(1)}L1000 40Z`;
    svg.setAttribute("viewBox", "0 0 1000 40");
    svg.innerHTML = `<defs><clipPath id="past"><rect x="0" y="0" width="0" height="40"/></clipPath></defs>` +
                    `<path class="ahead" d="${path}"/><path class="past" d="${path}" clip-path="url(#past)"/>`;
    this.past = svg.querySelector("#past rect");
    const ticks = element("div", "ticks");
    for (const event of events) {
      const tick = element("i", event.tone);
      tick.style.left = 100 * event.at / last + "%";
      ticks.append(tick);
    }
    svg.after(ticks);
    this.last = last;
  }

  show(i) {
    this.past.setAttribute("width", 1000 * i / this.last);
  }
}

