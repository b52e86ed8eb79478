// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Programs for the graphics card, WebGL 2. Places are unit vectors; a view takes them to the screen: as a globe, where
// what is behind the horizon is clipped, or as the square of Web Mercator, x to the east and y to the south from 0 to 1.

const projection = `#version 300 es
precision highp float;
uniform mat4 matrix;
uniform vec4 horizon;     // globe: a place p is seen if dot(p, horizon.xyz) + horizon.w >= 0
uniform bool isGlobe;
uniform bool isCrossing;  // Mercator: the western longitudes are drawn east of the antimeridian
uniform float copy;       // Mercator: the number of turns to the east
out float east;           // Mercator: x

vec2 mercator(vec3 p) {
  float lon = p.x == 0.0 && p.y == 0.0 ? 0.0 : atan(p.y, p.x);
  if (isCrossing && lon < 0.0) lon += 6.283185307;
  float lat = sign(p.z) * log((abs(p.z) + 1.0) / max(length(p.xy), 1e-3));
  return vec2(lon, -lat) / 6.283185307 + 0.5;
}

vec4 project(vec3 p) {
  east = 0.0;
  if (isGlobe) {
    vec4 place = matrix * vec4(p, 1.0);
    place.z = (1.0 - dot(p, horizon.xyz) - horizon.w) * place.w;
    return place;
  }
  vec2 m = mercator(p);
  east = m.x + copy;
  return matrix * vec4(east, m.y, 0.0, 1.0);
}
`;

// FLAT is "flat" for values of cells: the last corner of a triangle has the value, and the site. Of triangles no site is
// asked for.
const meshVertex = `${projection}
layout(location = 0) in vec3 position;
layout(location = 1) in float value;
SITE
FLAT out float v;
flat out uint s;

void main() {
  v = value;
  s = site;
  gl_Position = project(position);
}
`;

// An arc is two triangles; its corners are on both sides of it, half a width away, and as far beyond its ends.
const lineVertex = `${projection}
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in float level;
uniform vec2 viewport;  // pixels
uniform float width;    // pixels
out float v;
flat out uint s;

void main() {
  v = level;
  s = 0u;
  vec4 b = project(to);
  float eastOfTo = east;
  vec4 a = project(from);
  vec2 along = (b.xy / b.w - a.xy / a.w) * viewport;
  along = dot(along, along) > 0.0 ? normalize(along) : vec2(1.0, 0.0);
  vec2 across = vec2(-along.y, along.x);
  bool isEnd = gl_VertexID == 1 || gl_VertexID == 3 || gl_VertexID == 4;
  float side = gl_VertexID == 2 || gl_VertexID == 4 || gl_VertexID == 5 ? 1.0 : -1.0;
  vec4 place = isEnd ? b : a;
  if (isEnd) east = eastOfTo;
  place.xy += (side * across + (isEnd ? along : -along)) * width / viewport * place.w;
  gl_Position = a.w > 0.0 && b.w > 0.0 ? place : vec4(0.0, 0.0, 2.0, 1.0);
}
`;

const fragment = `#version 300 es
precision highp float;
uniform sampler2D ramp;
uniform vec2 domain;
uniform vec4 color;       // with alpha above 0 it is taken in place of the ramp; from 0 to 1
uniform float opacity;
uniform bool isPremultiplied;
uniform float pickedAlpha;  // above 0: the number of the site is drawn
uniform bool isGlobe;
uniform vec2 world;       // Mercator: the range of x that is drawn
in float east;
FLAT in float v;
flat in uint s;
out vec4 result;

void main() {
  if (!isGlobe && (east < world.x || east > world.y)) discard;
  if (pickedAlpha > 0.0) {
    uint number = s + 1u;
    result = vec4(vec3(uvec3(number, number >> 8, number >> 16) & 255u) / 255.0, pickedAlpha);
    return;
  }
  if (color.a <= 0.0 && v < -1e30) discard;  // no value
  float t = domain.y > domain.x ? (v - domain.x) / (domain.y - domain.x) : 0.5;
  vec4 c = color.a > 0.0 ? color : texture(ramp, vec2((clamp(t, 0.0, 1.0) * 255.0 + 0.5) / 256.0, 0.5));
  c.a *= opacity;
  result = isPremultiplied ? vec4(c.rgb * c.a, c.a) : c;
}
`;

/** What stands for no value on the graphics card, where NaN cannot be relied on. */
export const noValue = -3e38;

/** @param {string} text @param {string} flat @param {string} site */
const filled = (text, flat, site) => text.replace("FLAT", flat).replace("SITE", site);

/** The sources of the programs: for cells, for triangles, for lines. */
export const sources = {
  cells: [meshVertex, fragment].map((text) => filled(text, "flat", "layout(location = 2) in uint site;")),
  triangles: [meshVertex, fragment].map((text) => filled(text, "", "const uint site = 0u;")),
  lines: [lineVertex, fragment].map((text) => filled(text, "", "")),
};
