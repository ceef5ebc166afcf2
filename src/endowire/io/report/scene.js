// --- scene.js: the vessel and the wire on a canvas.

const least_wire_px = 1.9;      // radius at which a wire is still seen
const sheath_mm = 22;           // of sheath shown behind the access
const lens_mm = 34;             // of vessel in the lens at the tip

/** Colours of the wire from no force to the most; the first follows the theme. */
const ramp_stops = [null, "#0b7f8c", "#efa93c", "#df5a24", "#a80f3f"];

function rgb(text) {
  const value = text.trim();
  return [1, 3, 5].map(i => parseInt(value.slice(i, i + 2), 16) / 255);
}

class Scene {
  constructor(canvas, most_force) {
    this.canvas = canvas;
    this.most_force = most_force;
    const gl = canvas.getContext("webgl2", { alpha: false, antialias: true, stencil: true, powerPreference: "low-power" });
    if (!gl) throw new Error("This browser offers no WebGL 2, which the vessel is drawn with.");
    this.gl = gl;
    this.camera = new Camera(run.view.up, run.view.forward);
    this.glass = compile(gl, glass);
    this.wire = compile(gl, wire);
    this.vessel = this.makeVessel();
    this.tube = { array: gl.createVertexArray(), corners: gl.createBuffer(), index: gl.createBuffer(), count: 0 };
    this.sheath = { array: gl.createVertexArray(), corners: gl.createBuffer(), index: gl.createBuffer(), count: 0 };
    const back = times(-1, unit(run.access.direction));
    const from = run.access.position_mm;
    const steps = 6;
    const line = Array.from({ length: steps + 1 }, (_, i) => add(from, times(i / steps * sheath_mm, back))).flat();
    this.upload(this.sheath, tubeOf(steps + 1, line, new Float32Array(steps + 1).fill(1.1),
                                    new Float32Array(steps + 1).fill(-1)));
    this.ramp = gl.createTexture();
    this.room = { top: 24, bottom: 24 };  // what lies over the edges of the canvas, in pixels
  }

  makeVessel() {
    const gl = this.gl;
    const position = decode(run.vessel.position_mm, Float32Array);
    const corners = decode(run.vessel.corners, Uint32Array);
    this.low = [Infinity, Infinity, Infinity];
    this.high = [-Infinity, -Infinity, -Infinity];
    const extend = values => {
      for (let i = 0; i < values.length; i++) {
        this.low[i % 3] = Math.min(this.low[i % 3], values[i]);
        this.high[i % 3] = Math.max(this.high[i % 3], values[i]);
      }
    };
    extend(position);
    extend(run.access.position_mm);
    if (corners.length === 0) for (const frame of frames) extend(frame.position);
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    [["position", position], ["normal", normalsOf(position, corners)]].forEach(([name, values]) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
      const at = gl.getAttribLocation(this.glass.program, name);
      gl.enableVertexAttribArray(at);
      gl.vertexAttribPointer(at, 3, gl.FLOAT, false, 0, 0);
    });
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, corners, gl.STATIC_DRAW);
    gl.bindVertexArray(null);
    return { array, count: corners.length };
  }

  upload(target, { corners, index }) {
    const gl = this.gl;
    gl.bindVertexArray(target.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, target.corners);
    gl.bufferData(gl.ARRAY_BUFFER, corners, gl.DYNAMIC_DRAW);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, target.index);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, index, gl.DYNAMIC_DRAW);
    [["centre", 3, 0], ["around", 3, 12], ["radius", 1, 24], ["force", 1, 28]].forEach(([name, size, offset]) => {
      const at = gl.getAttribLocation(this.wire.program, name);
      gl.enableVertexAttribArray(at);
      gl.vertexAttribPointer(at, size, gl.FLOAT, false, 4 * floats_per_corner, offset);
    });
    gl.bindVertexArray(null);
    target.count = index.length;
  }

  /** The whole vessel. @param yaw  0 from the front */
  home(yaw) {
    this.camera.yaw = yaw;
    this.camera.pitch = 0;
    const [right, up] = this.camera.axes();
    const size = sub(this.high, this.low);
    const across = axis => Math.abs(axis[0]) * size[0] + Math.abs(axis[1]) * size[1] + Math.abs(axis[2]) * size[2];
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const { top, bottom } = this.room;
    this.camera.pixels_per_mm = Math.min((width - 48) / across(right), (height - top - bottom) / across(up));
    this.camera.centre = add(times(0.5, add(this.low, this.high)),
                             times(0.5 * (top - bottom) / this.camera.pixels_per_mm, up));
  }

  show(frame) {
    this.frame = frame;
    if (frame) this.upload(this.tube, tubeOf(frame.points, frame.position, frame.radius, frame.force));
    else this.tube.count = 0;
  }

  tip() {
    return this.frame ? Array.from(this.frame.position.subarray(0, 3)) : run.access.position_mm;
  }

  paint(colours) {
    const gl = this.gl;
    this.colours = colours;
    const stops = ramp_stops.map(stop => rgb(stop || colours.wire));
    const texels = new Uint8Array(256 * 4);
    for (let i = 0; i < 256; i++) {
      const place = i / 255 * (stops.length - 1);
      const k = Math.min(stops.length - 2, Math.floor(place));
      for (let c = 0; c < 3; c++) texels[4 * i + c] = 255 * (stops[k][c] + (place - k) * (stops[k + 1][c] - stops[k][c]));
      texels[4 * i + 3] = 255;
    }
    gl.bindTexture(gl.TEXTURE_2D, this.ramp);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, texels);
    for (const edge of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, edge, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
  }

  /** One picture. @param lens  the box of the lens in CSS pixels from the left lower corner of the canvas, or null */
  draw(lens) {
    const gl = this.gl;
    const ratio = Math.min(2, window.devicePixelRatio || 1);
    const { clientWidth, clientHeight } = this.canvas;
    const width = Math.round(clientWidth * ratio), height = Math.round(clientHeight * ratio);
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
    gl.disable(gl.SCISSOR_TEST);
    gl.clearColor(...rgb(this.colours.stage), 1);
    gl.stencilMask(0xff);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
    this.drawOne([0, 0, width, height], clientWidth, clientHeight, this.camera.pixels_per_mm, this.camera.centre);
    if (!lens || !this.frame) return;
    const box = [lens.left, lens.bottom, lens.size, lens.size].map(v => Math.round(v * ratio));
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(...box);
    gl.clearColor(...rgb(this.colours.lens), 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
    this.drawOne(box, lens.size, lens.size, lens.size / lens_mm, this.tip());
  }

  drawOne(box, width, height, pixels_per_mm, centre) {
    const gl = this.gl;
    gl.viewport(...box);
    const matrix = this.camera.matrix(width, height, pixels_per_mm, centre);
    const [right, up, out] = this.camera.axes();
    const glassPass = share => {
      if (this.vessel.count === 0) return;
      gl.useProgram(this.glass.program);
      gl.uniformMatrix4fv(this.glass.at.matrix, false, matrix);
      gl.uniform3fv(this.glass.at.out_of_picture, out);
      gl.uniform3fv(this.glass.at.tint, rgb(this.colours.glass));
      gl.uniform2f(this.glass.at.opacity, 0.06 * share, 0.6 * share);
      gl.enable(gl.BLEND);
      gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
      gl.depthMask(false);
      gl.bindVertexArray(this.vessel.array);
      gl.drawElements(gl.TRIANGLES, this.vessel.count, gl.UNSIGNED_INT, 0);
    };
    // 1. all of the glass; 2. the wire on top, marked in the stencil; 3. where there is wire, the glass in front of it.
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.STENCIL_TEST);
    glassPass(1);
    gl.disable(gl.BLEND);
    gl.enable(gl.DEPTH_TEST);
    gl.depthMask(true);
    gl.enable(gl.STENCIL_TEST);
    gl.stencilFunc(gl.ALWAYS, 1, 0xff);
    gl.stencilOp(gl.KEEP, gl.KEEP, gl.REPLACE);
    gl.useProgram(this.wire.program);
    gl.uniformMatrix4fv(this.wire.at.matrix, false, matrix);
    gl.uniform3fv(this.wire.at.right, right);
    gl.uniform3fv(this.wire.at.up, up);
    gl.uniform3fv(this.wire.at.out_of_picture, out);
    gl.uniform1f(this.wire.at.most_force, this.most_force);
    gl.uniform3fv(this.wire.at.sheath, rgb(this.colours.sheath));
    gl.bindTexture(gl.TEXTURE_2D, this.ramp);
    for (const [part, px] of [[this.tube, least_wire_px], [this.sheath, 1.6 * least_wire_px]]) {
      if (part.count === 0) continue;
      gl.uniform1f(this.wire.at.least_radius, px / pixels_per_mm);
      gl.bindVertexArray(part.array);
      gl.drawElements(gl.TRIANGLES, part.count, gl.UNSIGNED_INT, 0);
    }
    gl.stencilFunc(gl.EQUAL, 1, 0xff);
    gl.stencilOp(gl.KEEP, gl.KEEP, gl.KEEP);
    glassPass(0.45);
    gl.depthMask(true);
    gl.bindVertexArray(null);
  }

  /** How many pixels are not the stage's own colour; asked right after a picture. */
  drawnPixels() {
    const gl = this.gl;
    const pixels = new Uint8Array(4 * this.canvas.width * this.canvas.height);
    gl.readPixels(0, 0, this.canvas.width, this.canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    const stage = rgb(this.colours.stage).map(v => Math.round(255 * v));
    let count = 0;
    for (let i = 0; i < pixels.length; i += 4)
      if (stage.some((value, c) => Math.abs(pixels[i + c] - value) > 3)) count++;
    return count;
  }
}

