// --- shaders.js: what the graphics card does.

// The vessel as tinted glass: every layer of wall takes away light, a grazing layer more than one face on. All layers
// have one colour, so their order does not matter and nothing is sorted.
const glass = {
  vertex: `#version 300 es
    uniform mat4 matrix;
    uniform vec3 out_of_picture;
    in vec3 position;
    in vec3 normal;
    out float facing;
    void main() {
      facing = dot(normal, out_of_picture);
      gl_Position = matrix * vec4(position, 1.0);
    }`,
  fragment: `#version 300 es
    precision highp float;
    uniform vec3 tint;
    uniform vec2 opacity;  // face on, grazing
    in float facing;
    out vec4 colour;
    void main() {
      float grazing = 1.0 - min(1.0, abs(facing));
      float alpha = mix(opacity.x, opacity.y, grazing * grazing * grazing);
      colour = vec4(alpha * tint, alpha);
    }`,
};

// The wire: rings about its axis, never thinner than a few pixels, coloured by wall force.
const wire = {
  vertex: `#version 300 es
    uniform mat4 matrix;
    uniform vec3 right, up, out_of_picture;
    uniform float least_radius;  // mm
    in vec3 centre;
    in vec3 around;              // from the axis to the surface, length one
    in float radius;             // mm
    in float force;              // N/mm; negative: the sheath
    out vec3 normal;
    out float load;
    void main() {
      normal = vec3(dot(around, right), dot(around, up), dot(around, out_of_picture));
      load = force;
      gl_Position = matrix * vec4(centre + around * max(radius, least_radius), 1.0);
    }`,
  fragment: `#version 300 es
    precision highp float;
    uniform sampler2D ramp;
    uniform float most_force;
    uniform vec3 sheath;
    in vec3 normal;
    in float load;
    out vec4 colour;
    void main() {
      vec3 n = normalize(normal);
      vec3 base = load < 0.0 ? sheath : texture(ramp, vec2(sqrt(clamp(load / most_force, 0.0, 1.0)), 0.5)).rgb;
      float light = 0.78 + 0.30 * max(0.0, dot(n, normalize(vec3(-0.4, 0.7, 0.6)))) - 0.22 * (1.0 - max(0.0, n.z));
      colour = vec4(base * light, 1.0);
    }`,
};

function compile(gl, source) {
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, source.vertex], [gl.FRAGMENT_SHADER, source.fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  const at = {};
  for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i++) {
    const name = gl.getActiveUniform(program, i).name;
    at[name] = gl.getUniformLocation(program, name);
  }
  return { program, at };
}

