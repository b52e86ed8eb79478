// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Pictures by packages that call d3-geo-voronoi, or what a bundle has in its place: polygons over both poles and over
// the antimeridian, with holes, whose triangles they take from it, and one that they triangulate otherwise.

import { geoDelaunay } from "d3-geo-voronoi";
import Globe from "globe.gl";
import { geoTriangulate } from "rondel/polygons";
import {
  AmbientLight,
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  MeshNormalMaterial,
  PerspectiveCamera,
  Scene,
  SphereGeometry,
  WebGLRenderer,
} from "three";
import ConicPolygonGeometry from "three-conic-polygon-geometry";
import ThreeGlobe from "three-globe";

const size = 300;
const views = { antimeridian: [0, 20, -300], north: [20, 300, 30], south: [-30, -300, 10] };

/** A closed ring of n points given by their number's share of the whole. @param {number} n @param {(t: number) => number[]} at */
const ring = (n, at) => [...Array.from({ length: n }, (_, i) => at(i / n)), at(0)];

/** A wavy ring around a pole; outer ones are clockwise. @param {number} lat @param {number} waves */
const aroundPole = (lat, waves, direction) =>
  ring(60, (t) => [direction * (180 - 360 * t), lat + 4 * Math.sin(2 * Math.PI * waves * t)]);

/** An ellipse. @param {number} lon @param {number} lat @param {number} width @param {number} direction */
const ellipse = (lon, lat, width, direction) =>
  ring(40, (t) => {
    const turn = 2 * Math.PI * t * direction;
    const x = lon + width * Math.sin(turn);
    return [x > 180 ? x - 360 : x, lat + 0.6 * width * Math.cos(turn)];
  });

const polygons = [
  { color: "#d62728", coordinates: [aroundPole(62, 5, 1), ellipse(40, 75, 12, -1)] },
  { color: "#2ca02c", coordinates: [aroundPole(-68, 7, -1)] },
  { color: "#ff7f0e", coordinates: [ellipse(175, 10, 30, 1), ellipse(172, 12, 8, -1)] },
  { color: "#9467bd", coordinates: [ellipse(-120, -10, 20, 1)] },
];
const features = polygons.map(({ color, coordinates }) => ({ color, geometry: { type: "Polygon", coordinates } }));

/** What a camera sees from each place, as the bytes of colors in base64. */
function pictures(renderer, scene, camera) {
  const gl = renderer.getContext();
  const result = {};
  for (const [name, place] of Object.entries(views)) {
    camera.position.set(...place);
    camera.lookAt(0, 0, 0);
    renderer.render(scene, camera);
    const bytes = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
    gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    result[name] = btoa(Array.from(bytes, (b) => String.fromCharCode(b)).join(""));
  }
  return result;
}

/** A scene on a white ground, drawn by three.js alone. */
function drawn(...objects) {
  const scene = new Scene();
  scene.background = new Color("white");
  scene.add(...objects);
  const renderer = new WebGLRenderer();
  renderer.setSize(size, size);
  const camera = new PerspectiveCamera(50, 1, 1, 1000);
  const result = pictures(renderer, scene, camera);
  renderer.dispose();
  return result;
}

/** Waits until a globe has made the geometries of all polygons. */
async function allPolygons(scene, isPolygon = (object) => object.geometry?.type === "ConicPolygonGeometry") {
  for (;;) {
    let number = 0;
    scene.traverse((object) => (number += isPolygon(object) && object.geometry.index?.count > 0));
    if (number >= features.length) return;
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
}

const settings = (globe) =>
  globe
    .showAtmosphere(false)
    .polygonsData(features)
    .polygonCapColor("color")
    .polygonSideColor(() => "#333333")
    .polygonStrokeColor(() => "#000000")
    .polygonAltitude(0.03)
    .polygonsTransitionDuration(0);

/** A polygon's triangles as an object of a custom layer of three-globe and globe.gl. */
const triangulated = (globe) => ({ color, coordinates }) => {
  const { points, triangles } = geoTriangulate({ type: "Polygon", coordinates }, { spacing: 3 });
  const xyz = points.flatMap(([lon, lat]) => Object.values(globe.getCoords(lat, lon, 0.03)));
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(Float32Array.from(xyz), 3));
  geometry.setIndex(triangles.flat());
  geometry.computeVertexNormals();
  return Object.assign(new Mesh(geometry, new MeshLambertMaterial({ color })), { name: "triangulated" });
};
const isTriangulated = ({ name }) => name === "triangulated";

globalThis.globesTest = {
  /** Which implementation this is: d3's makes up triangles of points on one circle. */
  trianglesOnEquator: () =>
    geoDelaunay(Array.from({ length: 12 }, (_, i) => [30 * i, 0])).triangles.length,

  conicPolygons() {
    const caps = polygons.map(({ coordinates }) => {
      const geometry = new ConicPolygonGeometry(coordinates, 95, 103, true, true, true, 3);
      return new Mesh(geometry, new MeshNormalMaterial({ side: DoubleSide, flatShading: true }));
    });
    return drawn(new Mesh(new SphereGeometry(94, 60, 30), new MeshBasicMaterial({ color: "#cccccc" })), ...caps);
  },

  async threeGlobe() {
    const globe = settings(new ThreeGlobe({ animateIn: false }));
    await allPolygons(globe);
    return drawn(globe, new AmbientLight("white", 3));
  },

  /** The polygons by geoTriangulate(), in custom layers. */
  async triangulatedThreeGlobe() {
    const globe = new ThreeGlobe({ animateIn: false }).showAtmosphere(false).customLayerData(polygons);
    globe.customThreeObject(triangulated(globe));
    await allPolygons(globe, isTriangulated);
    return drawn(globe, new AmbientLight("white", 3));
  },

  async triangulatedGlobeGl() {
    const element = document.createElement("div");
    document.body.append(element);
    const globe = new Globe(element, { animateIn: false, waitForGlobeReady: false });
    globe.showAtmosphere(false).customLayerData(polygons).customThreeObject(triangulated(globe));
    globe.width(size).height(size).backgroundColor("#ffffff").enablePointerInteraction(false);
    await allPolygons(globe.scene(), isTriangulated);
    globe.pauseAnimation();
    const result = pictures(globe.renderer(), globe.scene(), globe.camera());
    globe._destructor();
    return result;
  },

  async globeGl() {
    const element = document.createElement("div");
    document.body.append(element);
    const globe = settings(new Globe(element, { animateIn: false, waitForGlobeReady: false }))
      .width(size)
      .height(size)
      .backgroundColor("#ffffff")
      .enablePointerInteraction(false);
    await allPolygons(globe.scene());
    globe.pauseAnimation();
    const result = pictures(globe.renderer(), globe.scene(), globe.camera());
    globe._destructor();
    return result;
  },
};
