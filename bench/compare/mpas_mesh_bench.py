# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Centroidal meshes as files of MPAS: rw_mpas_mesh of gpuwm-hex and `rondel mesh scvt`, in turns.

    mpas_mesh_bench.py RW_MPAS_MESH RONDEL N [--cap] [--turns N] [--first N] [--limit SECONDS]

Whole commands, one thread each, from starts of their own to a mean distance of site and centroid of 1e-3 spacings; of one
spacing, or (--cap) of 30 km in a cap of 1,200 km that becomes 120 km over 3,000 km, in proportion, around another center in
each turn (--first: the number of the first turn). Prints a JSON object: medians of the seconds, their ratio, and what
`rondel mesh quality` finds in the last files.
rw_mpas_mesh is in the package's folder gpuwm/libexec/bridges.
"""

import argparse
import json
import math
import os
import pathlib
import statistics
import subprocess
import tempfile
import time

KILOMETERS = 6371.229  # of a radian
NEAR, FAR, INNER, WIDTH = 30.0, 120.0, 1200.0, 3000.0


def center_of(turn):
    """Longitude and latitude in degrees."""
    return (-98.0 + 47 * turn) % 360 - 180, 39.0 - 13 * turn


def write_spec(path, turn):
    lon, lat = center_of(turn)
    path.write_text(json.dumps({
        "background_km": FAR,
        "regions": [{"shape": {"kind": "cap", "center_deg": [lat, lon], "radius_km": INNER}, "spacing_km": NEAR,
                     "transition_km": WIDTH}],
    }))


def write_spacings(path, turn):
    """Every degree the spacing that grows evenly over the ring."""
    lon0, lat0 = map(math.radians, center_of(turn))
    with open(path, "w", encoding="ascii") as file:
        file.write("lon,lat,h\n")
        for lat in range(-89, 90):
            for lon in range(-180, 180):
                y, x = math.radians(lat), math.radians(lon)
                cosine = math.sin(y) * math.sin(lat0) + math.cos(y) * math.cos(lat0) * math.cos(x - lon0)
                distance = KILOMETERS * math.acos(max(-1.0, min(1.0, cosine)))
                part = max(0.0, min(1.0, (distance - INNER) / WIDTH))
                file.write(f"{lon},{lat},{NEAR + (FAR - NEAR) * part!r}\n")


def seconds_of(command, limit):
    """None where it takes longer; a refusal of the mesh is told by its status."""
    environment = {**os.environ, "RAYON_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    start = time.perf_counter()
    try:
        done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=limit, check=False)
    except subprocess.TimeoutExpired:
        return None
    if done.returncode != 0:
        raise SystemExit(f"{command[0]}: status {done.returncode}: {done.stderr.strip()[-500:]}")
    return time.perf_counter() - start


def quality_of(rondel, path):
    if not path.exists():
        return None
    found = json.loads(subprocess.run([rondel, "mesh", "quality", path, "--json"], check=True, capture_output=True,
                                      text=True).stdout)
    return {"min_edge_ratio": found["min_edge_ratio"]["value"], "num_obtuse": found["num_obtuse"],
            "mean_centroid_offset": found["mean_centroid_offset"], "sides": found["sides"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("peer")
    parser.add_argument("rondel")
    parser.add_argument("count", type=int)
    parser.add_argument("--cap", action="store_true")
    parser.add_argument("--turns", type=int, default=3)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--limit", type=float, default=3600)
    options = parser.parse_args()
    count = str(options.count)
    times = {"rw_mpas_mesh": [], "rondel": []}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        files = {program: folder / f"{program}.nc" for program in times}
        for turn in range(options.first, options.first + options.turns):
            theirs = [options.peer, "--out", files["rw_mpas_mesh"], "--clobber", "--cells", count, "--tolerance", "1e-3"]
            ours = [options.rondel, "mesh", "scvt", "-n", count, "-o", files["rondel"], "--tolerance", "1e-3",
                    "--threads", "1"]
            if options.cap:
                write_spec(folder / "spec.json", turn)
                write_spacings(folder / "h.csv", turn)
                theirs += ["--spec", folder / "spec.json", "--fit-spacing", "yes"]
                ours += ["--spacing", f"{folder / 'h.csv'}:h", "--max-tolerance", "1"]
            else:
                spacing = KILOMETERS * math.sqrt(4 * math.pi / options.count * 2 / math.sqrt(3))
                theirs += ["--background-km", f"{spacing:.6f}", "--fit-spacing", "yes"]
            times["rw_mpas_mesh"].append(seconds_of(theirs, options.limit))
            times["rondel"].append(seconds_of(ours, options.limit))
        qualities = {program: quality_of(options.rondel, path) for program, path in files.items()}
    medians = {program: statistics.median(seen) for program, seen in times.items() if None not in seen}
    ratio = medians["rw_mpas_mesh"] / medians["rondel"] if len(medians) == 2 else None
    print(json.dumps({"cells": options.count, "cap": options.cap, "seconds": times, "medians": medians, "ratio": ratio,
                      "quality": qualities}))


if __name__ == "__main__":
    main()
