// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cells of sites, and a polygon around the north pole, as geometries of three.js.

import { BufferAttribute, BufferGeometry, Color, Mesh, MeshBasicMaterial, PerspectiveCamera, Scene, WebGLRenderer } from "three";
import { geoTriangulate } from "rondel/polygons";
import { surface, vertexValues } from "rondel/surface";
import { makeField } from "./field.js";

const told = document.getElementById("told");
const element = document.getElementById("map");
const radians = Math.PI / 180;

/** three.js has y to the north: its x, y, z are y, z, x of rondel. */
const axes = (xyz, radius) => Float32Array.from(xyz, (_, k) => radius * xyz[3 * Math.floor(k / 3) + ((k + 1) % 3)]);

/** The cells: each triangle has its own three corners, in the color of its site. */
function cellsOf(field) {
  const mesh = surface(field);
  const values = vertexValues(mesh, field.values);
  const geometry = new BufferGeometry();
  const positions = axes(mesh.positions, 1);
  const all = new Float32Array(3 * mesh.indices.length);
  const colors = new Float32Array(3 * mesh.indices.length);
  const color = new Color();
  mesh.indices.forEach((vertex, k) => {
    all.set(positions.subarray(3 * vertex, 3 * vertex + 3), 3 * k);
    color.setHSL(0.55 - 0.2 * values[mesh.indices[k - (k % 3) + 2]], 0.5, 0.5).toArray(colors, 3 * k);
  });
  geometry.setAttribute("position", new BufferAttribute(all, 3));
  geometry.setAttribute("color", new BufferAttribute(colors, 3));
  return new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true }));
}

/** A polygon as d3-geo has it, with triangles of about 5 degrees, a hundredth above the ground. */
function polygonOf(coordinates) {
  const { points, triangles } = geoTriangulate({ type: "Polygon", coordinates }, { spacing: 5 });
  const xyz = points.flatMap(([lon, lat]) => [
    Math.cos(lat * radians) * Math.cos(lon * radians),
    Math.cos(lat * radians) * Math.sin(lon * radians),
    Math.sin(lat * radians),
  ]);
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(axes(xyz, 1.01), 3));
  geometry.setIndex(triangles.flat());
  return new Mesh(geometry, new MeshBasicMaterial({ color: "#d62728" }));
}

const star = Array.from({ length: 16 }, (_, i) => [180 - 22.5 * i, i % 2 === 0 ? 85 : 70]);
const field = makeField(Number(new URLSearchParams(location.search).get("sites") ?? 2000));
const scene = new Scene();
scene.background = new Color("#10151f");
scene.add(cellsOf(field), polygonOf([[...star, star[0]]]));

const camera = new PerspectiveCamera(40, element.clientWidth / element.clientHeight, 0.1, 10);
camera.position.set(0.6, 2.2, 2.2);
camera.lookAt(0, 0, 0);
const renderer = new WebGLRenderer({ antialias: true });
renderer.setSize(element.clientWidth, element.clientHeight);
element.append(renderer.domElement);
renderer.render(scene, camera);
told.textContent = `${field.lon.length} sites`;

globalThis.example = { field };
