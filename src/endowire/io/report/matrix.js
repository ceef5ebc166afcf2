// --- matrix.js: vectors of three numbers, and how the vessel is turned.

const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const times = (s, a) => [s * a[0], s * a[1], s * a[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = a => Math.hypot(a[0], a[1], a[2]);
const unit = a => times(1 / (length(a) || 1), a);
const turned = (a, axis, angle) => add(add(times(Math.cos(angle), a), times(Math.sin(angle), cross(axis, a))),
                                       times(dot(axis, a) * (1 - Math.cos(angle)), axis));

/**
 * A camera without perspective, so that a millimetre is equally long everywhere: it turns about the long axis of the
 * vessel (yaw) and tips over (pitch).
 */
class Camera {
  constructor(up, forward) {
    this.up = up;
    this.forward = forward;
    this.centre = [0, 0, 0];
    this.yaw = 0;
    this.pitch = 0;
    this.pixels_per_mm = 1;
  }
  /** Right, up and out of the picture. */
  axes() {
    const forward = turned(this.forward, this.up, this.yaw);
    const right = cross(forward, this.up);
    const tipped = turned(forward, right, this.pitch);
    return [right, cross(right, tipped), times(-1, tipped)];
  }
  /** From millimetres to the square of a viewport of that many pixels; column by column, for WebGL. */
  matrix(width, height, pixels_per_mm = this.pixels_per_mm, centre = this.centre) {
    const [right, up, out] = this.axes();
    const x = 2 * pixels_per_mm / width, y = 2 * pixels_per_mm / height;
    const z = -1e-4;  // 20 m of depth: every vessel, from everywhere
    return new Float32Array([
      x * right[0], y * up[0], z * out[0], 0,
      x * right[1], y * up[1], z * out[1], 0,
      x * right[2], y * up[2], z * out[2], 0,
      -x * dot(right, centre), -y * dot(up, centre), -z * dot(out, centre), 1]);
  }
  /** Place on the screen of a point, in pixels from the middle, y downwards. */
  project(point) {
    const [right, up] = this.axes();
    const from = sub(point, this.centre);
    return [this.pixels_per_mm * dot(right, from), -this.pixels_per_mm * dot(up, from)];
  }
}

