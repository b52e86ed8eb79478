// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The four programs of the graphics processor.
//
// Positions are relative to a place `o` of the sphere: `shift` is o less the middle of the picture in the camera's
// frame, which the processor computes in doubles. What is left is small where the zoom is large, so that nothing
// shakes. Depth is z = 1 + forward * (p - middle): in front if it is positive.

const place = `#version 300 es
precision highp float;
uniform mat3 turn;
uniform vec3 shift;
uniform float zoom;
uniform vec2 screen;
out float depth;
vec3 placed(vec3 offset) {
  vec3 v = turn * offset + shift;
  return vec3(zoom * v.xy, 1.0 + v.z);
}
vec4 onScreen(vec2 pixels) { return vec4(2.0 * pixels / screen, 0.0, 1.0); }
`;

// A segment is a rectangle of four corners, a little wider than the line, whose rim fades.
const lineVertex = `${place}
layout(location = 0) in vec3 begin;
layout(location = 1) in vec3 end;
uniform float width;
out float off;
void main() {
  vec3 a = placed(begin);
  vec3 b = placed(end);
  vec2 along = b.xy - a.xy;
  float size = length(along);
  along = size > 0.0 ? along / size : vec2(1.0, 0.0);
  float side = (gl_VertexID & 1) == 0 ? -1.0 : 1.0;
  vec3 here = gl_VertexID < 2 ? a : b;
  off = side * (0.5 * width + 0.75);
  depth = here.z;
  gl_Position = onScreen(here.xy + off * vec2(-along.y, along.x));
}`;

const lineFragment = `#version 300 es
precision highp float;
uniform vec4 paint;
uniform float width;
in float depth;
in float off;
out vec4 result;
void main() {
  if (depth < 0.0) discard;
  float opaque = clamp(0.5 * max(width, 1.0) + 0.5 - abs(off), 0.0, 1.0) * min(width, 1.0);
  result = paint * opaque;
}`;

// The fourth number is the place in the color map, negative without a value; of a hidden site -10.
const fillVertex = `${place}
layout(location = 0) in vec4 corner;
out float level;
void main() {
  vec3 here = placed(corner.xyz);
  depth = here.z;
  level = corner.w;
  gl_Position = onScreen(here.xy);
}`;

const fillFragment = `#version 300 es
precision highp float;
uniform sampler2D colors;
uniform vec4 blank;
in float depth;
in float level;
out vec4 result;
void main() {
  if (depth < 0.0) discard;
  result = level < 0.0 ? blank : texture(colors, vec2(level, 0.5));
}`;

const pointVertex = `${place}
layout(location = 0) in vec4 site;
uniform float size;
out float level;
void main() {
  vec3 here = placed(site.xyz);
  depth = here.z;
  level = site.w;
  gl_Position = onScreen(here.xy);
  gl_PointSize = size + 1.0;
}`;

const pointFragment = `#version 300 es
precision highp float;
uniform sampler2D colors;
uniform vec4 paint;
uniform vec4 paintHidden;
uniform vec4 blank;
uniform float size;
uniform float ink;
uniform bool isFilled;
in float depth;
in float level;
out vec4 result;
void main() {
  float away = length(gl_PointCoord - 0.5) * (size + 1.0);
  float opaque = clamp(0.5 * size + 0.5 - away, 0.0, 1.0);
  if (depth < 0.0 || opaque == 0.0) discard;
  vec4 plain = level < -5.0 ? paintHidden : paint;
  vec4 filled = level < 0.0 ? blank : texture(colors, vec2(level, 0.5));
  result = (isFilled && level > -5.0 ? filled : plain * ink) * opaque;
}`;

const globeVertex = `#version 300 es
precision highp float;
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}`;

// Ocean, land and the glow around the limb.
const globeFragment = `#version 300 es
precision highp float;
uniform mat3 turn;
uniform float zoom;
uniform vec2 screen;
uniform sampler2D lands;
uniform float landShare;
uniform vec4 sky;
uniform vec4 glow;
uniform vec4 ocean;
uniform vec4 land;
out vec4 result;
void main() {
  vec2 at = (gl_FragCoord.xy - 0.5 * screen) / zoom;
  float radius = length(at);
  float outside = clamp((radius - 1.0) * zoom + 0.5, 0.0, 1.0);
  vec4 around = mix(sky, glow, 0.55 * exp(-14.0 * max(radius - 1.0, 0.0)));
  float height = sqrt(max(0.0, 1.0 - radius * radius));
  vec3 p = vec3(at, height) * turn;
  vec2 there = vec2(atan(p.y, p.x) / 6.283185307 + 0.5, 0.5 - asin(clamp(p.z, -1.0, 1.0)) / 3.141592654);
  float isLand = smoothstep(0.35, 0.65, textureLod(lands, there, 0.0).r) * landShare;
  vec4 ground = mix(ocean, land, isLand) * vec4(vec3(mix(0.9, 1.0, smoothstep(0.0, 0.55, height))), 1.0);
  ground = mix(ground, glow, 0.45 * pow(1.0 - height, 4.0));
  result = mix(ground, around, outside);
}`;

function compile(gl, kind, text) {
  const shader = gl.createShader(kind);
  gl.shaderSource(shader, text);
  gl.compileShader(shader);
  return shader;
}

// A linked program and where its uniforms are, by name.
function link(gl, vertex, fragment) {
  const program = gl.createProgram();
  gl.attachShader(program, compile(gl, gl.VERTEX_SHADER, vertex));
  gl.attachShader(program, compile(gl, gl.FRAGMENT_SHADER, fragment));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  const uniforms = {};
  const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS);
  for (let i = 0; i < count; ++i) {
    const { name } = gl.getActiveUniform(program, i);
    uniforms[name] = gl.getUniformLocation(program, name);
  }
  return { program, uniforms };
}

export function linkPrograms(gl) {
  return {
    line: link(gl, lineVertex, lineFragment),
    fill: link(gl, fillVertex, fillFragment),
    point: link(gl, pointVertex, pointFragment),
    globe: link(gl, globeVertex, globeFragment),
  };
}
