# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Meshes of a sea by Rondel, Gmsh and seamsh: microseconds a vertex, and the smallest angles.

    python3 coast_mesh_bench.py LAND.geojson SPACING_KM [TURNS]

The sea is what LAND leaves of a circle of 30 degrees around 40 N 30 W, its coast simplified by a
quarter of the spacing. Rondel fills it on the sphere; Gmsh (algorithms 5, Delaunay, and 6,
frontal-Delaunay) and seamsh in the stereographic plane, with the same corners and with the spacing
multiplied by the scale of the projection, which keeps angles. Rondel reads shapely polygons, and the
others make their geometry, before time is taken. Prints medians of the turns in seconds of
processors, one thread; a program that is not installed is left out. The circle is turned by a
degree in each turn, so that no input comes twice.
"""

from __future__ import annotations

import importlib
import json
import math
import os
import statistics
import sys
import tempfile
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import shapely
import shapely.geometry

import rondel.mesh

EARTH_KM = 6371.229
RADIUS = math.radians(30)


def unit(lon: Any, lat: Any) -> Any:
    lon, lat = np.radians(lon), np.radians(lat)
    return np.stack([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)], axis=-1)


class Plane:
    """A stereographic projection around a place."""

    def __init__(self, lon: float, lat: float):
        self.up = unit(lon, lat)
        self.east = unit(lon + 90, 0)
        self.north = np.cross(self.up, self.east)

    def project(self, points: Any) -> Any:
        return np.stack([points @ self.east, points @ self.north], axis=-1) * (
            2 / (1 + points @ self.up)[..., None]
        )

    @staticmethod
    def scale(xy: Any) -> Any:
        return 1 + np.sum(np.square(xy), axis=-1) / 4


def sea_rings(land: Any, lon: float, lat: float, spacing: float) -> tuple[Any, list[Any]]:
    """The polygon of a sea with geodesic edges, and its rings as points."""
    circle = rondel.buffer([shapely.Point(lon, lat)], RADIUS, tolerance=spacing / 8)[0]
    sea = rondel.difference(circle, land)
    sea = rondel.simplify([sea], spacing / 4, edges="geodesic", drop_small=True)[0]
    parts = [max(shapely.get_parts(sea), key=lambda part: part.area)]
    rings = [np.asarray(ring.coords)[:-1] for ring in (parts[0].exterior, *parts[0].interiors)]
    return parts[0], [unit(ring[:, 0], ring[:, 1]) for ring in rings]


def divided(ring: Any, spacing: float) -> Any:
    """A ring with points along its arcs, as sides are no straight lines in the plane."""
    following = np.roll(ring, -1, axis=0)
    lengths = np.linalg.norm(following - ring, axis=1)
    made = []
    for p, q, length in zip(ring, following, lengths, strict=True):
        t = np.arange(max(1, math.ceil(length / spacing / 8)))[:, None]
        between = p + (q - p) * t / len(t)
        made.append(between / np.linalg.norm(between, axis=1, keepdims=True))
    return np.concatenate(made)


def angles(xyz: Any, triangles: Any) -> Any:
    corners = xyz[triangles]
    smallest = np.full(len(triangles), 180.0)
    for k in range(3):
        u = corners[:, (k + 1) % 3] - corners[:, k]
        v = corners[:, (k + 2) % 3] - corners[:, k]
        cosine = np.sum(u * v, 1) / np.linalg.norm(u, axis=1) / np.linalg.norm(v, axis=1)
        smallest = np.minimum(smallest, np.degrees(np.arccos(np.clip(cosine, -1, 1))))
    return smallest


def gmsh_model(gmsh: Any, rings: list[Any], spacing: float) -> None:
    gmsh.clear()
    loops = []
    for xy in rings:
        points = [gmsh.model.geo.addPoint(x, y, 0) for x, y in xy]
        sides = zip(points, [*points[1:], points[0]], strict=True)
        loops.append(gmsh.model.geo.addCurveLoop([gmsh.model.geo.addLine(p, q) for p, q in sides]))
    gmsh.model.geo.addPlaneSurface(loops, 1)
    gmsh.model.geo.synchronize()
    field = gmsh.model.mesh.field.add("MathEval")
    gmsh.model.mesh.field.setString(field, "F", f"{spacing!r}*(1+(x*x+y*y)/4)")
    gmsh.model.mesh.field.setAsBackgroundMesh(field)


def gmsh_triangles(gmsh: Any) -> tuple[Any, Any]:
    tags, xyz, _ = gmsh.model.mesh.getNodes()
    _, corners = gmsh.model.mesh.getElementsByType(2)
    places = np.zeros(int(tags.max()) + 1, int)
    places[tags.astype(int)] = np.arange(len(tags))
    return xyz.reshape(-1, 3), places[corners.astype(int)].reshape(-1, 3)


def by_gmsh(gmsh: Any, rings: list[Any], spacing: float, algorithm: int) -> Callable[[], Any]:
    for name, value in {
        "General.Terminal": 0,
        "General.NumThreads": 1,
        "Mesh.MeshSizeExtendFromBoundary": 0,
        "Mesh.MeshSizeFromPoints": 0,
        "Mesh.MeshSizeFromCurvature": 0,
        "Mesh.Algorithm": algorithm,
    }.items():
        gmsh.option.setNumber(name, value)
    gmsh_model(gmsh, rings, spacing)

    def run() -> Any:
        gmsh.model.mesh.generate(2)
        return gmsh_triangles(gmsh)

    return run


def by_seamsh(gmsh: Any, rings: list[Any], spacing: float, folder: str) -> Callable[[], Any]:
    geometry = importlib.import_module("seamsh.geometry")
    seamsh = importlib.import_module("seamsh.gmsh")
    osr = importlib.import_module("osgeo.osr")
    plane = osr.SpatialReference()
    plane.ImportFromProj4("+proj=stere +lat_0=90 +R=1 +units=m")
    domain = geometry.Domain(plane)
    for ring in rings:
        domain.add_boundary_curve(
            np.concatenate([ring, ring[:1]]), "coast", plane, geometry.CurveType.STRICTPOLYLINE
        )

    def run() -> Any:
        seamsh.mesh(
            domain,
            os.path.join(folder, "sea.msh"),
            lambda places, _: spacing * Plane.scale(places[:, :2]),
            smoothness=0.3,
        )
        gmsh.open(os.path.join(folder, "sea.msh"))
        return gmsh_triangles(gmsh)

    return run


def main() -> None:
    with open(sys.argv[1], encoding="utf-8") as file:
        features = json.load(file)["features"]
    land = rondel.union_all([shapely.geometry.shape(feature["geometry"]) for feature in features])
    spacing = float(sys.argv[2]) / EARTH_KM
    turns = int(sys.argv[3]) if len(sys.argv) > 3 else 3
    programs: dict[str, Any] = {}
    for name in ("gmsh", "seamsh"):
        try:
            programs[name] = importlib.import_module(name)
        except ImportError as error:
            print(f"without {name}: {error}", file=sys.stderr)
    gmsh = programs.get("gmsh")
    if gmsh and not gmsh.isInitialized():
        gmsh.initialize()
    found: dict[str, list[tuple[float, int, float, float]]] = {}
    with tempfile.TemporaryDirectory() as folder:
        for turn in range(turns):
            sea, rings = sea_rings(land, -30 + turn, 40, spacing)
            plane = Plane(-30 + turn, 40)
            flat = [plane.project(divided(ring, spacing)) for ring in rings]
            calls: dict[str, Callable[[], Any]] = {
                "rondel": lambda sea=sea: rondel.mesh.triangles(
                    area=[sea], spacing=spacing, tolerance=0, edges="geodesic", threads=1
                )
            }
            if gmsh:
                calls["gmsh, Delaunay"] = lambda f=flat: by_gmsh(gmsh, f, spacing, 5)
                calls["gmsh, frontal"] = lambda f=flat: by_gmsh(gmsh, f, spacing, 6)
            if "seamsh" in programs:
                calls["seamsh"] = lambda f=flat: by_seamsh(gmsh, f, spacing, folder)
            for name, call in calls.items():
                prepared = call if name == "rondel" else call()
                start = time.process_time()
                made = prepared()
                seconds = time.process_time() - start
                if name == "rondel":
                    made = made.points, made.triangles
                least = angles(made[0], made[1])
                found.setdefault(name, []).append(
                    (seconds, len(np.unique(made[1])), least.min(), np.mean(least < 26.5))
                )
    for name, rows in found.items():
        seconds, vertices, least, share = (statistics.median(column) for column in zip(*rows))
        print(
            f"{name}: {vertices} vertices, {seconds:.3g} s, {seconds / vertices * 1e6:.3g} us a "
            f"vertex; smallest angle {least:.1f}, {100 * share:.3f} % below 26.5"
        )


main()
