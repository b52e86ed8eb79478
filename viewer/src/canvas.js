// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The canvas and what is sent to it: buffers, textures, draw calls. Counts the vertices of each frame.

import { colorMap } from "./colors.js";
import { linkPrograms } from "./programs.js";

const identity = [1, 0, 0, 0, 1, 0, 0, 0, 1];

export class Canvas {
  // `restored` is called when the context came back after it was lost, with nothing in it.
  constructor(element, restored) {
    this.element = element;
    const gl = element.getContext("webgl2", { antialias: true, alpha: false, powerPreference: "high-performance" });
    if (gl === null) throw new Error("This page needs WebGL 2, which this browser or its graphics driver does not offer.");
    this.gl = gl;
    this.prepare();
    element.addEventListener("webglcontextlost", (event) => event.preventDefault());  // or it does not come back
    element.addEventListener("webglcontextrestored", () => {
      this.prepare();
      restored();
    });
  }

  prepare() {
    const { gl } = this;
    this.programs = linkPrograms(gl);
    this.loose = { lines: gl.createBuffer(), corners: gl.createBuffer(), indices: gl.createBuffer(), sites: gl.createBuffer() };
    this.colors = this.texture(gl.CLAMP_TO_EDGE);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, colorMap());
    this.lands = this.texture(gl.REPEAT);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.R8, 1, 1, 0, gl.RED, gl.UNSIGNED_BYTE, new Uint8Array(1));
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.disable(gl.DEPTH_TEST);
    this.numVertices = 0;
  }

  texture(wrap) {
    const { gl } = this;
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, wrap);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    return texture;
  }

  setLand(picture) {
    const { gl } = this;
    gl.bindTexture(gl.TEXTURE_2D, this.lands);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.R8, gl.RED, gl.UNSIGNED_BYTE, picture);
  }

  // A buffer of its own for what is drawn in many frames.
  keep(data, target = this.gl.ARRAY_BUFFER) {
    const buffer = this.gl.createBuffer();
    this.gl.bindBuffer(target, buffer);
    this.gl.bufferData(target, data, this.gl.STATIC_DRAW);
    return buffer;
  }

  refill(buffer, data, target = this.gl.ARRAY_BUFFER) {
    this.gl.bindBuffer(target, buffer);
    this.gl.bufferData(target, data, this.gl.DYNAMIC_DRAW);
    return buffer;
  }

  // `scale`: device pixels of a pixel of the camera.
  begin(camera, scale) {
    const { gl } = this;
    this.camera = camera;
    this.scale = scale;
    this.numVertices = 0;
    gl.viewport(0, 0, this.element.width, this.element.height);
    const [r, u, f] = [camera.right, camera.up, camera.forward];
    this.turn = [r[0], u[0], f[0], r[1], u[1], f[1], r[2], u[2], f[2]];
  }

  use(program, settings) {
    const { gl } = this;
    gl.useProgram(program.program);
    for (const [name, value] of Object.entries(settings)) {
      const at = program.uniforms[name];
      if (at === undefined) continue;
      if (name === "turn") gl.uniformMatrix3fv(at, false, value);
      else if (typeof value === "boolean" || name === "lands" || name === "colors") gl.uniform1i(at, value);
      else if (typeof value === "number") gl.uniform1f(at, value);
      else gl[`uniform${value.length}fv`](at, value);
    }
  }

  // Where a place of the sphere is: what shaders call turn, shift and zoom. Without a place: pixels.
  frame(center) {
    const { camera, scale } = this;
    const screen = [this.element.width, this.element.height];
    if (center === null) return { turn: identity, shift: [0, 0, 0], zoom: scale, screen };
    const d = center.map((x, k) => x - camera.forward[k]);
    const shift = [camera.right, camera.up, camera.forward].map((axis) => axis[0] * d[0] + axis[1] * d[1] + axis[2] * d[2]);
    return { turn: this.turn, shift, zoom: camera.zoom * scale, screen };
  }

  attribute(index, buffer, size, stride, offset, divisor) {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(index);
    gl.vertexAttribPointer(index, size, gl.FLOAT, false, stride, offset);
    gl.vertexAttribDivisor(index, divisor);
  }

  drawGlobe(theme, landShare) {
    const { gl, programs } = this;
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.lands);
    const { sky, glow, ocean, land } = theme;
    this.use(programs.globe, { ...this.frame([0, 0, 0]), lands: 0, landShare, sky, glow, ocean, land });
    for (const index of [0, 1]) gl.disableVertexAttribArray(index);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    this.numVertices += 3;
  }

  // `count` segments of six numbers.
  drawLines(buffer, count, center, paint, width) {
    if (count === 0) return;
    const { gl, programs } = this;
    this.use(programs.line, { ...this.frame(center), paint, width: width * this.scale });
    this.attribute(0, buffer, 3, 24, 0, 1);
    this.attribute(1, buffer, 3, 24, 12, 1);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, count);
    this.numVertices += 4 * count;
  }

  drawCells(corners, indices, count, center, theme) {
    if (count === 0) return;
    const { gl, programs } = this;
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.colors);
    this.use(programs.fill, { ...this.frame(center), colors: 0, blank: theme.blank });
    gl.disableVertexAttribArray(1);
    this.attribute(0, corners, 4, 16, 0, 0);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, indices);
    gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, 0);
    this.numVertices += count;
  }

  // `look`: size in pixels; ink, how opaque dots are, from 0 to 1; isFilled, whether they have the colors of cells.
  drawSites(buffer, first, count, center, theme, { size, ink, isFilled }) {
    if (count === 0) return;
    const { gl, programs } = this;
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.colors);
    this.use(programs.point, {
      ...this.frame(center), colors: 0, blank: theme.blank, paint: theme.site, paintHidden: theme.hidden,
      size: size * this.scale, ink, isFilled,
    });
    gl.disableVertexAttribArray(1);
    this.attribute(0, buffer, 4, 16, 16 * first, 0);
    gl.drawArrays(gl.POINTS, 0, count);
    this.numVertices += count;
  }
}
