# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Sides of projected geometries, which are straight in the projection, as sides in degrees."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._types import FloatArray, IntArray

TOLERANCE_DEG = 1e-4
MOST_PIECES = 4096


def with_divided_sides(geometries: Any, crs: Any, target: Any) -> Any:
    """Adds corners to sides that are straight in `crs` and bend when converted to `target`.

    Each piece of a side lies within 1e-4 degrees of a straight line in longitude and latitude,
    unless the side already has 4096 pieces, as may happen next to a pole. A side is divided alike
    from both directions, so that neighbors still share it.

    Parameters
    ----------
    geometries : geopandas.GeoSeries or geopandas.GeoDataFrame
        Geometries with coordinates in `crs`.
    crs : pyproj.CRS
        The projection, with planar coordinates.
    target : pyproj.CRS or int
        The system to convert to later, in degrees; an int is its EPSG code.

    Returns
    -------
    geopandas.GeoSeries or geopandas.GeoDataFrame
        Geometries still in `crs`, with the additional corners.

    """
    from pyproj import Transformer

    transform = Transformer.from_crs(crs, target, always_xy=True).transform
    shapes = geometries.geometry
    divided = [_divided(shape, transform) for shape in shapes]
    made = type(shapes)(divided, index=shapes.index, name=shapes.name, crs=crs)
    return made if geometries is shapes else geometries.set_geometry(made)


def _divided(shape: Any, transform: Any) -> Any:
    if shape is None or shape.is_empty:
        return shape
    if hasattr(shape, "geoms"):
        return type(shape)([_divided(part, transform) for part in shape.geoms])
    if hasattr(shape, "exterior"):
        holes = [_line(ring.coords, transform) for ring in shape.interiors]
        return type(shape)(_line(shape.exterior.coords, transform), holes)
    return shape if shape.geom_type == "Point" else type(shape)(_line(shape.coords, transform))


def _line(coords: Any, transform: Any) -> FloatArray:
    corners = np.asarray(coords)[:, :2]
    a, b = corners[:-1], corners[1:]
    is_turned = (a[:, 0] > b[:, 0]) | ((a[:, 0] == b[:, 0]) & (a[:, 1] > b[:, 1]))
    first = np.where(is_turned[:, None], b, a)
    step = np.where(is_turned[:, None], a, b) - first
    counts = _pieces(first, step, transform)
    if (counts == 1).all():
        return corners
    side = np.repeat(np.arange(len(counts)), counts)
    within = np.arange(len(side)) - np.repeat(np.cumsum(counts) - counts, counts)
    from_first = np.where(is_turned[side], counts[side] - within, within)
    points = first[side] + step[side] * (from_first / counts[side])[:, None]
    points[within == 0] = a
    return np.concatenate([points, corners[-1:]])


def _pieces(first: FloatArray, step: FloatArray, transform: Any) -> IntArray:
    """How many pieces each side has: a power of 2."""
    counts = np.ones(len(first), np.intp)
    bent = np.arange(len(first))
    pieces = 1
    while len(bent) > 0 and pieces < MOST_PIECES:
        shares = np.arange(2 * pieces + 1) / (2 * pieces)
        points = first[bent, None] + step[bent, None] * shares[:, None]
        lon, lat = transform(points[..., 0], points[..., 1])
        bent = bent[_bend(lon, lat) > TOLERANCE_DEG]
        pieces *= 2
        counts[bent] = pieces
    return counts


def _bend(lon: FloatArray, lat: FloatArray) -> FloatArray:
    """The greatest distance in degrees of a middle from the line between the ends, in each row."""
    east = _turn(lon[:, 2::2] - lon[:, :-2:2]) / 2
    lon_off = _turn(lon[:, 1::2] - lon[:, :-2:2] - east) * np.cos(np.radians(lat[:, 1::2]))
    lat_off = lat[:, 1::2] - (lat[:, 2::2] + lat[:, :-2:2]) / 2
    return np.asarray(np.hypot(lon_off, lat_off).max(axis=1))


def _turn(degrees: FloatArray) -> FloatArray:
    return np.asarray((degrees + 180) % 360 - 180)
