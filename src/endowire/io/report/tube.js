// --- tube.js: surfaces for the graphics card.

const around = 10;        // corners of a ring of the wire
const floats_per_corner = 8;  // centre, direction from the axis, radius, force

/** Normals at the vertices of a mesh, by area. */
function normalsOf(position, corners) {
  const normal = new Float32Array(position.length);
  const at = i => [position[3 * i], position[3 * i + 1], position[3 * i + 2]];
  for (let t = 0; t < corners.length; t += 3) {
    const a = at(corners[t]);
    const n = cross(sub(at(corners[t + 1]), a), sub(at(corners[t + 2]), a));
    for (let k = 0; k < 3; k++) for (let c = 0; c < 3; c++) normal[3 * corners[t + k] + c] += n[c];
  }
  for (let i = 0; i < normal.length; i += 3) {
    const size = Math.hypot(normal[i], normal[i + 1], normal[i + 2]) || 1;
    for (let c = 0; c < 3; c++) normal[i + c] /= size;
  }
  return normal;
}

/**
 * Rings along a line of points, closed by round caps. A ring is a centre and directions from the axis: how far the
 * surface lies from it is for the shader to say.
 */
function tubeOf(points, position, radius, force) {
  const at = i => [position[3 * i], position[3 * i + 1], position[3 * i + 2]];
  const rings = [];
  let side = null;
  for (let i = 0; i < points; i++) {
    const along = unit(sub(at(Math.max(0, i - 1)), at(Math.min(points - 1, i + 1))));  // towards the tip
    const other = Math.abs(along[0]) < 0.7 ? [1, 0, 0] : [0, 1, 0];
    side = unit(sub(side || other, times(dot(side || other, along), along)));
    if (!(length(side) > 0.5)) side = unit(cross(along, other));
    const ring = tilt => rings.push({ i, along, side, tilt });
    if (i === 0) for (const tilt of [1.5, 1.0, 0.5]) ring(tilt);
    ring(0);
    if (i === points - 1) for (const tilt of [-0.5, -1.0, -1.5]) ring(tilt);
  }
  const corners = new Float32Array(rings.length * around * floats_per_corner);
  let k = 0;
  for (const { i, along, side: first, tilt } of rings) {
    const second = cross(along, first);
    for (let j = 0; j < around; j++) {
      const a = 2 * Math.PI * j / around;
      for (let c = 0; c < 3; c++) {
        corners[k + c] = position[3 * i + c];
        corners[k + 3 + c] =
          Math.cos(tilt) * (Math.cos(a) * first[c] + Math.sin(a) * second[c]) + Math.sin(tilt) * along[c];
      }
      corners[k + 6] = radius[i];
      corners[k + 7] = Number.isFinite(force[i]) ? force[i] : 0;
      k += floats_per_corner;
    }
  }
  const index = new Uint32Array((rings.length - 1) * around * 6);
  k = 0;
  for (let r = 0; r + 1 < rings.length; r++)
    for (let j = 0; j < around; j++) {
      const a = r * around + j, b = r * around + (j + 1) % around;
      index.set([a, b, a + around, b, b + around, a + around], k);
      k += 6;
    }
  return { corners, index };
}

