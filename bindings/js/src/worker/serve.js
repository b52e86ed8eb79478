// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The code that runs in the worker. It answers messages {id, object, method, args} by {id, value} or {id, error}.
// Objects stay in the worker and are referred to by numbers.

import { DynamicTriangulation } from "../dynamic.js";
import { delaunay, voronoi } from "../build.js";
import { RondelError } from "../errors.js";
import { DrawnSites } from "../surface/sites.js";

const properties = ["dimension", "numSites", "numVertices", "numFaces"];
const arrays = ["triangles", "neighbors", "ghostFaces", "ring", "duplicates", "hidden"];
const dualArrays = ["centers", "cells", "areas"];

/** @type {Map<number, any>} */
const objects = new Map();
let lastObject = 0;

/** @param {any} object */
function keep(object) {
  objects.set(++lastObject, object);
  return lastObject;
}

/**
 * Keeps an object, and returns its number and some of its properties. It is freed if they cannot be read, as where
 * memory runs out.
 * @param {any} object
 * @param {string[]} names
 */
function described(object, names) {
  try {
    const read = Object.fromEntries(names.map((name) => [name, object[name]]));
    return { object: keep(object), ...read };
  } catch (error) {
    object.free();
    throw error;
  }
}

const makers = {
  /** @param {any[]} args */
  delaunay: (...args) => described(delaunay(.../** @type {[any]} */ (args)), [...properties, ...arrays]),
  /** @param {any[]} args */
  voronoi: (...args) => described(voronoi(.../** @type {[any]} */ (args)), [...properties, ...arrays, ...dualArrays]),
  /** @param {any[]} args */
  triangulate: async (...args) => {
    const { triangulate } = await import("../polygons/triangulate.js"); // most workers do not load it
    return triangulate(.../** @type {[any]} */ (args));
  },
  /** @param {any[]} args */
  sites: (...args) => described(new DrawnSites(.../** @type {[any]} */ (args)), ["numSites"]),
  /** @param {any[]} args */
  dynamic: (...args) => described(new DynamicTriangulation(...args), []),
};

/** @param {{object: number, method: string, args: any[]}} message */
function answer({ object, method, args }) {
  if (object === 0) return /** @type {any} */ (makers)[method](...args);
  const target = objects.get(object);
  if (target === undefined && method !== "free") throw new RondelError(`${method}() is used after free()`, 0);
  if (method === "free") return void (objects.delete(object) && target.free());
  if (method === "snapshot") return described(target.snapshot(), [...properties, ...arrays, ...dualArrays]);
  if (method === "ids") return target.ids;
  return target[method](...args);
}

/**
 * The buffers of all arrays in a value.
 * @param {any} value
 * @returns {ArrayBuffer[]}
 */
function buffersOf(value) {
  if (ArrayBuffer.isView(value)) return [/** @type {ArrayBuffer} */ (value.buffer)];
  if (value === null || typeof value !== "object") return [];
  return Object.values(value).flatMap(buffersOf);
}

/** @param {any} message @param {(reply: any, transfer: ArrayBuffer[]) => void} post */
export async function serve(message, post) {
  try {
    const value = await answer(message);
    post({ id: message.id, value }, [...new Set(buffersOf(value))]);
  } catch (error) {
    const { name, message: text, index } = /** @type {any} */ (error);
    post({ id: message.id, error: { name, text, index } }, []);
  }
}
