// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Draws a mesh or lines by WebGL 2, into whatever its host has bound.

import { ramp, rampSize } from "./colors.js";
import { noValue, sources } from "./shaders.js";

/** @typedef {import("../surface/lines.js").Lines} Lines */
/** @typedef {import("../surface/meshes.js").Mesh} Mesh */

/**
 * How places get to the screen.
 * @typedef {object} View
 * @property {boolean} isGlobe or Web Mercator
 * @property {ArrayLike<number>} matrix 4 x 4, by columns, from unit vectors or the Mercator square to clip space
 * @property {ArrayLike<number>} horizon globe: the plane of the horizon; what is on its positive side is seen
 * @property {[number, number]} copies Mercator: the first and the last turn to the east that is drawn, 0 being the world
 * @property {[number, number]} viewport pixels
 */

/**
 * @typedef {object} Style
 * @property {[number, number]} domain the values of the first and the last color
 * @property {readonly number[]} color red, green, blue, alpha from 0 to 1; alpha 0: colors of the ramp
 * @property {number} opacity
 * @property {number} width of lines, pixels
 * @property {boolean} isPremultiplied whether the host blends premultiplied colors
 * @property {number} pickedAlpha above 0: the numbers of sites are drawn in place of colors, with this alpha
 */

/** @param {WebGL2RenderingContext} gl @param {string[]} texts of the vertex and the fragment shader */
function linked(gl, texts) {
  const program = /** @type {WebGLProgram} */ (gl.createProgram());
  [gl.VERTEX_SHADER, gl.FRAGMENT_SHADER].forEach((kind, i) => {
    const shader = /** @type {WebGLShader} */ (gl.createShader(kind));
    gl.shaderSource(shader, texts[i]);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
    gl.deleteShader(shader);
  });
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
    throw new Error(`Rondel: a program for the graphics card: ${gl.getProgramInfoLog(program)}`);
  }
  return program;
}

/** The drawing of one mesh, or of lines. */
export class Renderer {
  /** @type {WebGLBuffer[]} */
  #buffers = [];
  #uniforms = new Map();
  #count = 0;
  #numCrossing = 0;

  /**
   * @param {WebGL2RenderingContext} gl
   * @param {Mesh | Lines} drawn
   */
  constructor(gl, drawn) {
    this.gl = gl;
    this.isLines = "segments" in drawn;
    const kind = this.isLines ? "lines" : drawn.show === "cells" ? "cells" : "triangles";
    this.program = linked(gl, sources[kind]);
    this.vertices = gl.createVertexArray();
    this.texture = gl.createTexture();
    gl.bindVertexArray(this.vertices);
    if ("segments" in drawn) this.#placeLines(drawn);
    else this.#placeMesh(drawn);
    gl.bindVertexArray(null);
    gl.bindBuffer(gl.ARRAY_BUFFER, null);
  }

  /** Makes a buffer that stays bound. @param {number} target @param {ArrayBufferView | null} data */
  #buffer(target, data) {
    const { gl } = this;
    const buffer = /** @type {WebGLBuffer} */ (gl.createBuffer());
    gl.bindBuffer(target, buffer);
    if (data) gl.bufferData(target, data, gl.STATIC_DRAW);
    this.#buffers.push(buffer);
    return buffer;
  }

  /** @param {Mesh} mesh */
  #placeMesh({ positions, indices, numCrossing, sites }) {
    const { gl } = this;
    this.#buffer(gl.ARRAY_BUFFER, positions);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
    this.values = this.#buffer(gl.ARRAY_BUFFER, new Float32Array(positions.length / 3).fill(noValue));
    gl.enableVertexAttribArray(1);
    gl.vertexAttribPointer(1, 1, gl.FLOAT, false, 0, 0);
    if (sites) {
      this.#buffer(gl.ARRAY_BUFFER, sites);
      gl.enableVertexAttribArray(2);
      gl.vertexAttribIPointer(2, 1, gl.UNSIGNED_INT, 0, 0);
    }
    this.#buffer(gl.ELEMENT_ARRAY_BUFFER, indices);
    this.#count = indices.length / 3;
    this.#numCrossing = numCrossing;
  }

  /** @param {Lines} lines */
  #placeLines({ segments, levels, numCrossing }) {
    const { gl } = this;
    this.segments = this.#buffer(gl.ARRAY_BUFFER, segments);
    this.levels = levels && this.#buffer(gl.ARRAY_BUFFER, levels);
    for (const place of levels ? [0, 1, 2] : [0, 1]) {
      gl.enableVertexAttribArray(place);
      gl.vertexAttribDivisor(place, 1);
    }
    this.#count = segments.length / 6;
    this.#numCrossing = numCrossing;
  }

  /** Sets the values of vertices; NaN: none. @param {Float32Array} values */
  setValues(values) {
    const { gl } = this;
    const known = values.map((value) => (Number.isFinite(value) ? value : noValue));
    gl.bindBuffer(gl.ARRAY_BUFFER, this.values ?? null);
    gl.bufferData(gl.ARRAY_BUFFER, known, gl.DYNAMIC_DRAW);
    gl.bindBuffer(gl.ARRAY_BUFFER, null);
  }

  /** @param {readonly import("./colors.js").Color[]} colors */
  setColors(colors) {
    const { gl } = this;
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.pixelStorei(gl.UNPACK_FLIP_Y_WEBGL, false);
    gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, false);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, rampSize, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, ramp(colors));
    for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST);
    gl.bindTexture(gl.TEXTURE_2D, null);
  }

  /** @param {string} name */
  #uniform(name) {
    if (!this.#uniforms.has(name)) this.#uniforms.set(name, this.gl.getUniformLocation(this.program, name));
    return this.#uniforms.get(name);
  }

  /** Draws elements first ... first + number - 1. @param {number} first @param {number} number */
  #drawSome(first, number) {
    const { gl } = this;
    if (number === 0) return;
    if (!this.isLines) {
      gl.drawElements(gl.TRIANGLES, 3 * number, gl.UNSIGNED_INT, 12 * first);
      return;
    }
    gl.bindBuffer(gl.ARRAY_BUFFER, this.segments ?? null);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 24, 24 * first);
    gl.vertexAttribPointer(1, 3, gl.FLOAT, false, 24, 24 * first + 12);
    if (this.levels) {
      gl.bindBuffer(gl.ARRAY_BUFFER, this.levels);
      gl.vertexAttribPointer(2, 1, gl.FLOAT, false, 4, 4 * first);
    }
    gl.drawArraysInstanced(gl.TRIANGLES, 0, 6, number);
  }

  /** Draws everything. @param {View} view @param {Style} style */
  draw(view, style) {
    const { gl } = this;
    gl.useProgram(this.program);
    gl.bindVertexArray(this.vertices);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    const [first, last] = view.copies;
    gl.uniform1i(this.#uniform("ramp"), 0);
    gl.uniformMatrix4fv(this.#uniform("matrix"), false, Float32Array.from(view.matrix));
    gl.uniform4fv(this.#uniform("horizon"), Float32Array.from(view.horizon));
    gl.uniform1i(this.#uniform("isGlobe"), Number(view.isGlobe));
    gl.uniform2f(this.#uniform("viewport"), ...view.viewport);
    gl.uniform2f(this.#uniform("world"), first, last + 1);
    gl.uniform2f(this.#uniform("domain"), ...style.domain);
    gl.uniform4fv(this.#uniform("color"), Float32Array.from(style.color));
    gl.uniform1f(this.#uniform("opacity"), style.opacity);
    gl.uniform1f(this.#uniform("width"), style.width);
    gl.uniform1i(this.#uniform("isPremultiplied"), Number(style.isPremultiplied));
    gl.uniform1f(this.#uniform("pickedAlpha"), style.pickedAlpha);
    this.#drawCopies(view);
    gl.bindTexture(gl.TEXTURE_2D, null);
    gl.bindVertexArray(null);
    gl.bindBuffer(gl.ARRAY_BUFFER, null);
    gl.useProgram(null);
  }

  /** Draws the globe at once; of a map each turn, with what crosses the antimeridian at both ends. @param {View} view */
  #drawCopies({ isGlobe, copies: [first, last] }) {
    const { gl } = this;
    const numOther = this.#count - this.#numCrossing;
    gl.uniform1i(this.#uniform("isCrossing"), 0);
    gl.uniform1f(this.#uniform("copy"), 0);
    if (isGlobe) {
      this.#drawSome(0, this.#count);
      return;
    }
    for (let copy = first; copy <= last; ++copy) {
      gl.uniform1f(this.#uniform("copy"), copy);
      this.#drawSome(0, numOther);
    }
    gl.uniform1i(this.#uniform("isCrossing"), 1);
    for (let copy = first - 1; copy <= last; ++copy) {
      gl.uniform1f(this.#uniform("copy"), copy);
      this.#drawSome(numOther, this.#numCrossing);
    }
  }

  /** Frees what the graphics card has. */
  free() {
    const { gl } = this;
    for (const buffer of this.#buffers) gl.deleteBuffer(buffer);
    gl.deleteVertexArray(this.vertices);
    gl.deleteTexture(this.texture);
    gl.deleteProgram(this.program);
  }
}
