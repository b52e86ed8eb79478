# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The coasts of GSHHG at full resolution as polygons: 188,612 of them with 10.4 million corners.

    apt-get download gmt-gshhg-full && dpkg -x gmt-gshhg-full_*.deb gshhg
    python3 gshhg.py gshhg/usr/share/gmt-gshhg/binned_GSHHS_f.nc coasts.geojson
    python3 gshhg.py gshhg/usr/share/gmt-gshhg/binned_GSHHS_f.nc sites.npy sides.csv

GMT keeps them in bins of one degree. A segment begins and ends at a side of its bin, in exactly the
place where the next segment of its polygon begins, in units of 1/65535 degree.

in    netCDF-4 of GMT (needs netCDF4 and NumPy)
out   .geojson: a feature for each land and each island in a lake, with lakes as holes, Antarctica
      as far as its ice; or .npz: lonlat (n, 2), rings (offsets), level, gid and parent; or .npy and
      .csv: the different positions of all rings as x, y, z, and the sides of land between them
"""

from __future__ import annotations

import json
import sys
from collections import defaultdict
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np

UNIT = 65535  # of a degree
LAND, LAKE, ISLAND, POND = 1, 2, 3, 4


def joined(path: str) -> dict[str, np.ndarray[Any, Any]]:
    """All rings, without positions that follow themselves."""
    with netCDF4.Dataset(path) as data:
        known = {name: np.asarray(values[:]) for name, values in data.variables.items()}
    info = known["Embedded_npts_levels_exit_entry_for_a_segment"].astype(np.int64)
    first = known["Id_of_first_point_in_a_segment"].astype(np.int64)
    owners = known["Id_of_GSHHS_ID"].astype(np.int64)
    sizes, levels, is_open = info >> 9, (info >> 6) & 7, (info & 7) < 4
    num_in_bins = known["N_segments_in_a_bin"]
    bins = np.repeat(np.repeat(np.arange(len(num_in_bins)), num_in_bins), sizes)
    x = known["Relative_longitude_from_SW_corner_of_bin"].view(np.uint16) + bins % 360 * UNIT
    y = known["Relative_latitude_from_SW_corner_of_bin"].view(np.uint16)
    y = y + (89 - bins // 360) * UNIT
    x %= 360 * UNIT
    last = first + sizes - 1
    begins = defaultdict(list)
    for s in np.flatnonzero(is_open)[::-1]:
        begins[owners[s], x[first[s]], y[first[s]]].append(s)
    is_used = np.zeros(len(info), bool)
    positions, ids, ring_levels = [], [], []
    for start in range(len(info)):
        if is_used[start]:
            continue
        segments = [start]
        is_used[start] = True
        home = (owners[start], x[first[start]], y[first[start]])
        while (at := (owners[start], x[last[segments[-1]]], y[last[segments[-1]]])) != home:
            segments.append(next(s for s in begins[at] if not is_used[s]))
            is_used[segments[-1]] = True
        rows = np.concatenate([np.arange(first[s], last[s]) for s in segments])
        ring = np.column_stack([x[rows], y[rows]])
        ring = ring[(ring != np.roll(ring, 1, axis=0)).any(axis=1)]
        if len(ring) > 2:
            positions.append(ring)
            ids.append(owners[start])
            ring_levels.append(levels[start])
    lonlat = np.concatenate(positions) / UNIT
    lonlat[:, 0] -= 360 * (lonlat[:, 0] > 180)
    return {
        "lonlat": lonlat,
        "rings": np.concatenate([[0], np.cumsum([len(ring) for ring in positions])]),
        "level": np.array(ring_levels),
        "gid": np.array(ids),
        "parent": known["Id_of_parent_polygons"][ids],
    }


def unrolled(ring: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """A closed ring without jumps of longitude, led along the pole if it goes around it."""
    steps = (np.diff(ring[:, 0], append=ring[0, 0]) + 180) % 360 - 180
    if abs(steps.sum()) > 1:
        ring = np.roll(ring, -np.flatnonzero(ring[:, 0] == 180)[0], axis=0)
        west = ring[:1] - [360, 0]
        ring = np.concatenate([ring, west, [[-180, -90], [180, -90]]])
    else:
        lon = ring[0, 0] + np.concatenate([[0], np.cumsum(steps[:-1])])
        lon = ring[:, 0] + np.rint((lon - ring[:, 0]) / 360) * 360  # with the digits they have
        ring = np.column_stack([lon + 360 * (lon.min() < -180), ring[:, 1]])
    return np.concatenate([ring, ring[:1]])


def parts_of(rings: dict[str, np.ndarray[Any, Any]]) -> list[list[int]]:
    """The rings of each land and each island in a lake: itself, and the lakes in it."""
    shells: dict[int, list[int]] = defaultdict(list)
    for k in np.flatnonzero(np.isin(rings["level"], (LAND, ISLAND))):
        shells[rings["gid"][k]].append(k)
    features = [[k] for ks in shells.values() for k in ks]
    of_shell = {rings["gid"][ks[0]]: ks for ks in reversed(features)}
    for k in np.flatnonzero(np.isin(rings["level"], (LAKE, POND))):
        if rings["parent"][k] in of_shell:
            of_shell[rings["parent"][k]].append(k)
    return features


def polygon_of(
    rings: dict[str, np.ndarray[Any, Any]], ks: list[int], is_unrolled: bool
) -> list[np.ndarray[Any, Any]]:
    """The closed rings of a polygon; unrolled, without jumps of longitude."""
    offsets = rings["rings"]
    given = [rings["lonlat"][offsets[k] : offsets[k + 1]] for k in ks]
    if not is_unrolled:
        return [np.concatenate([ring, ring[:1]]) for ring in given]
    made = [unrolled(ring) for ring in given]
    for hole in made[1:]:
        low, high = made[0][:, 0].min(), made[0][:, 0].max()
        hole[:, 0] += 360 * ((hole[:, 0].min() < low) - int(hole[:, 0].max() > high))
    return made


def shapes_of(
    rings: dict[str, np.ndarray[Any, Any]], is_unrolled: bool
) -> np.ndarray[Any, np.dtype[np.object_]]:
    """The polygons as those of shapely."""
    import shapely

    made = [polygon_of(rings, ks, is_unrolled) for ks in parts_of(rings)]
    positions = [ring for polygon in made for ring in polygon]
    sizes = np.cumsum([0] + [len(ring) for ring in positions])
    ends = np.cumsum([0] + [len(polygon) for polygon in made])
    kind = shapely.GeometryType.POLYGON
    found: np.ndarray[Any, np.dtype[np.object_]] = shapely.from_ragged_array(
        kind, np.concatenate(positions), (sizes, ends)
    )
    return found


def write_geojson(rings: dict[str, np.ndarray[Any, Any]], path: str) -> None:
    """Writes lands and islands with their holes, a feature a line."""
    with Path(path).open("w") as file:
        file.write('{"type":"FeatureCollection","features":[')
        for number, ks in enumerate(parts_of(rings)):
            made = polygon_of(rings, ks, True)
            geometry = {"type": "Polygon", "coordinates": [ring.tolist() for ring in made]}
            facts = {"id": int(rings["gid"][ks[0]]), "level": int(rings["level"][ks[0]])}
            feature = {"type": "Feature", "properties": facts, "geometry": geometry}
            file.write((",\n" if number else "\n") + json.dumps(feature, separators=(",", ":")))
        file.write("\n]}\n")


def write_sides(rings: dict[str, np.ndarray[Any, Any]], sites: str, sides: str) -> None:
    """Writes positions in the order in which they come first, and sides as pairs of them."""
    lonlat, offsets = rings["lonlat"], rings["rings"]
    _, first, place = np.unique(lonlat, axis=0, return_index=True, return_inverse=True)
    order = np.argsort(first)
    number = np.argsort(order)[np.ravel(place)]
    lon, lat = np.radians(lonlat[first[order]]).T
    np.save(
        sites, np.column_stack([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)])
    )
    following = np.arange(1, len(lonlat) + 1)
    following[offsets[1:] - 1] = offsets[:-1]
    pairs = np.column_stack([number, number[following]])
    is_side = np.repeat(rings["level"] == LAND, np.diff(offsets)) & (pairs[:, 0] != pairs[:, 1])
    np.savetxt(sides, pairs[is_side], fmt="%d", delimiter=",")


if __name__ == "__main__":
    source, target = sys.argv[1:3]
    found = joined(source)
    if target.endswith(".npy"):
        write_sides(found, target, sys.argv[3])
    elif target.endswith(".npz"):
        np.savez(target, **found)
    else:
        write_geojson(found, target)
    print(f"{len(found['gid'])} rings with {len(found['lonlat'])} corners")
