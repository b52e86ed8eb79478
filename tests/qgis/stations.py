# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The stations with a number and a group, as GeoJSON for the tool and for QGIS."""

import csv
import math
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
PLUGIN = ROOT / "packaging" / "qgis" / "rondel_processing"
LAND = ROOT / "data" / "land-110m.geojson"


def stations():
    """Pairs of a geometry and properties; the value t is smooth but for a little, and missing for every 50th station."""
    with open(ROOT / "data" / "stations.csv", encoding="utf-8", newline="") as file:
        for i, row in enumerate(csv.DictReader(file)):
            lon, lat = float(row["longitude"]), float(row["latitude"])
            t = None if i % 50 == 0 else 30 * math.cos(math.radians(lat)) + 3 * math.sin(math.radians(2 * lon)) + i % 3 / 10
            yield {"type": "Point", "coordinates": [lon, lat]}, {"id": row["id"], "name": row["name"], "area": row["id"][:1], "t": t}
