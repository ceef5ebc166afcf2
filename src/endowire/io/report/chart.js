// --- chart.js: one quantity over insertion or time, with a mark at the step that is shown.

const chart_height = 92;
const chart_margin = { left: 44, right: 8, top: 8, bottom: 4 };

class Chart {
  /** @param lines  [{ values, className }], the first one is what the head shows */
  constructor(parent, { label, unit, lines, axis_below, seek }) {
    this.unit = unit;
    this.lines = lines;
    this.axis_below = axis_below;
    const box = element("figure", "chart");
    const head = element("figcaption", "");
    head.append(element("span", "", label), this.value = element("b"));
    box.append(head);
    // Markup without any data in it; the parser gives the elements their namespace.
    box.insertAdjacentHTML("beforeend",
      `<svg role="img"><g class="grid"></g><g class="paths"></g><line class="cursor"/><circle class="dot" r="3.5"/></svg>`);
    parent.append(box);
    this.svg = box.querySelector("svg");
    this.svg.setAttribute("aria-label", label);
    this.bottom = chart_margin.bottom + (axis_below ? 18 : 0);
    const at = event => {
      const x = event.clientX - this.svg.getBoundingClientRect().left;
      seek(this.nearest(x));
    };
    this.svg.addEventListener("pointerdown", event => {
      this.svg.setPointerCapture(event.pointerId);
      at(event);
    });
    this.svg.addEventListener("pointermove", event => {
      if (event.buttons) at(event);
    });
  }

  /** @param axis  name of the series that runs to the right */
  layout(axis) {
    this.axis = series[axis];
    this.width = this.svg.clientWidth || 300;
    const height = chart_height + this.bottom;
    this.svg.setAttribute("viewBox", `0 0 ${this.width} ${height}`);
    this.svg.style.height = height + "px";
    const finite = this.lines.flatMap(line => [Math.max(...chunks(line.values, Math.max)), Math.min(...chunks(line.values, Math.min))])
                             .filter(Number.isFinite);
    const most = Math.max(0, ...finite);
    let least = Math.min(0, ...finite);
    if (least > -0.03 * most) least = 0;  // not a whole line of the grid for a hair below zero
    const step = roundUp((most - least) / 3 || 1);
    this.high = Math.max(step, Math.ceil(most / step - 1e-9) * step);
    this.low = Math.floor(least / step + 1e-9) * step;
    const last = Math.max(1e-9, ...chunks(this.axis, Math.max));
    const { left, right, top } = chart_margin;
    this.x = value => left + value / last * (this.width - left - right);
    this.y = value => top + (this.high - value) / (this.high - this.low) * (height - top - this.bottom);
    this.drawGrid(step, last, axis === "time_s" ? "s" : "mm", height);
    this.drawLines();
  }

  drawGrid(step, last, unit, height) {
    const { left, right } = chart_margin;
    let markup = "";
    const decimals = Math.max(0, Math.ceil(-Math.log10(step) - 1e-9) + (/^[^1-9]*25/.test(String(step)) ? 1 : 0));
    for (let value = this.low; value <= this.high + 1e-9 * step; value += step) {
      const y = this.y(value).toFixed(1);
      markup += `<line x1="${left}" x2="${this.width - right}" y1="${y}" y2="${y}"${Math.abs(value) < 1e-9 ? ' class="zero"' : ""}/>` +
                `<text x="${left - 8}" y="${y}" dy="0.32em" text-anchor="end">${fixed(value, decimals)}</text>`;
    }
    if (this.axis_below) {
      const x_step = roundUp(last / 5);
      for (let value = 0; value <= last * (1 + 1e-9); value += x_step) {
        const end = value + x_step > last * (1 + 1e-9);
        markup += `<text x="${this.x(value).toFixed(1)}" y="${height - 4}" text-anchor="${value === 0 ? "start" : this.x(value) > this.width - 30 ? "end" : "middle"}">` +
                  `${fixed(value, x_step < 1 ? 1 : 0)}${end ? thin + unit : ""}</text>`;
      }
    }
    this.svg.querySelector(".grid").innerHTML = markup;
  }

  drawLines() {
    let markup = "";
    for (const { values, className } of this.lines) {
      let path = "", pen = false;
      for (let i = 0; i < series.count; i++) {
        const gap = !Number.isFinite(values[i]) || !Number.isFinite(this.axis[i]);
        if (!gap) path += `${pen ? "L" : "M"}${this.x(this.axis[i]).toFixed(1)} ${this.y(values[i]).toFixed(1)}`;
        pen = !gap;
      }
      markup = `<path class="${className}" d="${path}"/>` + markup;
    }
    this.svg.querySelector(".paths").innerHTML = markup;
  }

  /** The step drawn nearest to a place; where the wire went to and fro, the one nearest to the present step. */
  nearest(x) {
    let best = 0, least = Infinity;
    for (let i = 0; i < series.count; i++) {
      const away = Math.abs(this.x(this.axis[i]) - x) + 0.3 * Math.min(1, Math.abs(i - (this.shown || 0)) / series.count);
      if (away < least) { least = away; best = i; }
    }
    return best;
  }

  show(i) {
    this.shown = i;
    const value = this.lines[0].values[i];
    this.value.textContent = withUnit(digits(value), this.unit);
    if (!this.axis) return;
    const cursor = this.svg.querySelector(".cursor");
    const dot = this.svg.querySelector(".dot");
    const x = this.x(this.axis[i]);
    cursor.setAttribute("x1", x);
    cursor.setAttribute("x2", x);
    cursor.setAttribute("y1", chart_margin.top);
    cursor.setAttribute("y2", this.y(this.low));
    dot.setAttribute("cx", x);
    dot.setAttribute("cy", Number.isFinite(value) ? this.y(value) : -99);
  }
}

/** Extremes of a long array in pieces: a call takes only so many arguments. */
function chunks(values, extreme) {
  const found = [];
  for (let i = 0; i < values.length; i += 4096)
    found.push(extreme(...Array.from(values.subarray(i, i + 4096)).filter(Number.isFinite)));
  return found.filter(Number.isFinite);
}

