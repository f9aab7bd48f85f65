// The two programs of the graphics card: thick lines, and surfaces with light.

const LINE_VERTEX = `#version 300 es
in vec2 corner;
in vec3 from, to;
in vec4 colour;
uniform mat4 matrix;
uniform vec2 size;
uniform float width, nearer;
uniform int done;
uniform float rest;
out vec4 shade;
out float along, dash;
void main() {
  vec4 a = matrix * vec4(from, 1.0);
  vec4 b = matrix * vec4(to, 1.0);
  vec2 d = (b.xy - a.xy) * size * 0.5;
  float l = length(d);
  vec2 t = l > 1e-4 ? d / l : vec2(1.0, 0.0);
  vec2 n = vec2(-t.y, t.x);
  vec4 p = mix(a, b, corner.x);
  vec2 shift = n * corner.y * width * 0.5 + t * (corner.x * 2.0 - 1.0) * width * 0.35;
  gl_Position = vec4(p.xy + shift * 2.0 / size, p.z - nearer, 1.0);
  shade = vec4(colour.rgb, gl_InstanceID < done ? 1.0 : rest);
  dash = colour.a;
  along = corner.x * l;
}`;

const LINE_FRAGMENT = `#version 300 es
precision mediump float;
in vec4 shade;
in float along, dash;
out vec4 colour;
void main() {
  if (dash < 0.5 && mod(along, 10.0) > 6.0) discard;
  colour = shade;
}`;

const FACE_VERTEX = `#version 300 es
in vec3 place, normal;
uniform mat4 matrix;
uniform vec3 shift;
uniform vec3 light;
out float bright;
void main() {
  gl_Position = matrix * vec4(place + shift, 1.0);
  bright = 0.62 + 0.38 * abs(dot(normal, light));
}`;

const FACE_FRAGMENT = `#version 300 es
precision mediump float;
in float bright;
uniform vec4 tint;
out vec4 colour;
void main() { colour = vec4(tint.rgb * bright, tint.a); }`;

function compile(gl, vertex, fragment, names) {
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  names.forEach((name, i) => gl.bindAttribLocation(program, i, name));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
    throw new Error(gl.getProgramInfoLog(program) || 'The program for the graphics card fails.');
  }
  const uniforms = {};
  const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS);
  for (let i = 0; i < count; i++) {
    const { name } = gl.getActiveUniform(program, i);
    uniforms[name] = gl.getUniformLocation(program, name);
  }
  return { program, uniforms };
}

/** Makes the renderer of a canvas, or null when there is no WebGL 2. */
export function createRenderer(canvas) {
  const gl = canvas.getContext('webgl2', { antialias: true, alpha: false });
  if (!gl) return null;
  const lines = compile(gl, LINE_VERTEX, LINE_FRAGMENT, ['corner', 'from', 'to', 'colour']);
  const faces = compile(gl, FACE_VERTEX, FACE_FRAGMENT, ['place', 'normal']);
  const corners = gl.createBuffer();
  gl.bindBuffer(gl.ARRAY_BUFFER, corners);
  gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([0, -1, 0, 1, 1, -1, 1, 1]), gl.STATIC_DRAW);
  const renderer = { gl, lines, faces, corners };
  return {
    gl,
    /** Begins a picture: sizes in device pixels, the background as red, green, blue (0 to 255). */
    begin: (width, height, [r, g, b]) => begin(gl, width, height, r, g, b),
    makeLines: (data) => makeLines(renderer, data),
    makeFaces: (data) => makeFaces(renderer, data),
    drawLines: (mesh, options) => drawLines(renderer, mesh, options),
    drawFaces: (mesh, options) => drawFaces(renderer, mesh, options),
    /** Frees a mesh. */
    free: (mesh) => {
      if (!mesh) return;
      for (const buffer of mesh.buffers) gl.deleteBuffer(buffer);
      gl.deleteVertexArray(mesh.array);
    },
  };
}

function begin(gl, width, height, r, g, b) {
  gl.viewport(0, 0, width, height);
  gl.clearColor(r / 255, g / 255, b / 255, 1);
  gl.enable(gl.DEPTH_TEST);
  gl.depthFunc(gl.LEQUAL);
  gl.depthMask(true);
  gl.enable(gl.BLEND);
  gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
}

function attribute(gl, buffer, data, index, size, type, stride, offset, divisor) {
  gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
  if (data) gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
  gl.enableVertexAttribArray(index);
  gl.vertexAttribPointer(index, size, type, type === gl.UNSIGNED_BYTE, stride, offset);
  gl.vertexAttribDivisor(index, divisor);
}

// Lines: six numbers in mm for the ends of each, four bytes for its colour and dashes.
function makeLines({ gl, corners }, { places, colours }) {
  const array = gl.createVertexArray();
  gl.bindVertexArray(array);
  const [ends, shades] = [gl.createBuffer(), gl.createBuffer()];
  attribute(gl, corners, null, 0, 2, gl.FLOAT, 8, 0, 0);
  attribute(gl, ends, places, 1, 3, gl.FLOAT, 24, 0, 1);
  attribute(gl, ends, null, 2, 3, gl.FLOAT, 24, 12, 1);
  attribute(gl, shades, colours, 3, 4, gl.UNSIGNED_BYTE, 4, 0, 1);
  return { array, buffers: [ends, shades], count: places.length / 6 };
}

// Faces: triangles, six numbers for each corner: place in mm and normal.
function makeFaces({ gl }, data) {
  const array = gl.createVertexArray();
  gl.bindVertexArray(array);
  const buffer = gl.createBuffer();
  attribute(gl, buffer, data, 0, 3, gl.FLOAT, 24, 0, 0);
  attribute(gl, buffer, null, 1, 3, gl.FLOAT, 24, 12, 0);
  return { array, buffers: [buffer], count: data.length / 6 };
}

// Draws lines of a width in device pixels; those from `done` on are as opaque as `rest` (0 to 1).
function drawLines({ gl, lines }, mesh, options) {
  const { matrix, size, width, done = 2 ** 30, rest = 1, near = 0 } = options;
  if (!mesh || mesh.count === 0) return;
  gl.useProgram(lines.program);
  gl.uniformMatrix4fv(lines.uniforms.matrix, false, matrix);
  gl.uniform2f(lines.uniforms.size, ...size);
  gl.uniform1f(lines.uniforms.width, width);
  gl.uniform1f(lines.uniforms.nearer, near);
  gl.uniform1i(lines.uniforms.done, done);
  gl.uniform1f(lines.uniforms.rest, rest);
  gl.bindVertexArray(mesh.array);
  gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, mesh.count);
}

// Draws faces in a tint of red, green, blue (0 to 255) and opacity (0 to 1), moved by mm.
function drawFaces({ gl, faces }, mesh, { matrix, light, tint, opacity = 1, shift = [0, 0, 0] }) {
  if (!mesh || mesh.count === 0) return;
  gl.useProgram(faces.program);
  gl.uniformMatrix4fv(faces.uniforms.matrix, false, matrix);
  gl.uniform3f(faces.uniforms.shift, ...shift);
  gl.uniform3f(faces.uniforms.light, ...light);
  gl.uniform4f(faces.uniforms.tint, tint[0] / 255, tint[1] / 255, tint[2] / 255, opacity);
  gl.depthMask(opacity === 1);
  gl.bindVertexArray(mesh.array);
  gl.drawArrays(gl.TRIANGLES, 0, mesh.count);
  gl.depthMask(true);
}
