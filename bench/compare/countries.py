# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Countries of a TopoJSON file as lines of text, for countries_bench.

    npm pack world-atlas@2.0.2 && tar xzf world-atlas-2.0.2.tgz package/countries-10m.json
    python3 countries.py package/countries-10m.json countries.txt

Rounding has left fewer than three positions of some rings, which are left out.

out   a line `country` before each country, a line `polygon` before each of its polygons, and a line
      for each ring, the outer one first: longitudes and latitudes in degrees, in turns, without the
      first position again
"""

from __future__ import annotations

import json
import sys
from itertools import pairwise
from pathlib import Path
from typing import Any

Position = tuple[float, float]

LEAST = 3  # positions of a ring


def decoded(topology: dict[str, Any]) -> list[list[Position]]:
    """The arcs in degrees; in the file they are differences of integers."""
    scale_x, scale_y = topology["transform"]["scale"]
    begin_x, begin_y = topology["transform"]["translate"]
    arcs = []
    for arc in topology["arcs"]:
        x = y = 0
        positions = []
        for step_x, step_y in arc:
            x += step_x
            y += step_y
            positions.append((x * scale_x + begin_x, y * scale_y + begin_y))
        arcs.append(positions)
    return arcs


def ring(numbers: list[int], arcs: list[list[Position]], *, is_outer: bool) -> list[Position]:
    """Outer rings are counterclockwise, holes clockwise."""
    positions: list[Position] = []
    for number in numbers:
        arc = arcs[number] if number >= 0 else arcs[~number][::-1]
        positions += arc[1:]
    doubled = sum(p[0] * q[1] - q[0] * p[1] for p, q in pairwise([*positions, positions[0]]))
    return positions if (doubled > 0) == is_outer else positions[::-1]


def main(source: str, target: str) -> None:
    """Reads a file and writes the other one."""
    topology = json.loads(Path(source).read_text(encoding="utf-8"))
    arcs = decoded(topology)
    lines = []
    for country in topology["objects"]["countries"]["geometries"]:
        lines.append("country")
        rings = country["arcs"]
        for polygon in [rings] if country["type"] == "Polygon" else rings:
            outlines = [ring(numbers, arcs, is_outer=k == 0) for k, numbers in enumerate(polygon)]
            if len(outlines[0]) < LEAST:
                continue
            lines.append("polygon")
            for outline in outlines:
                if len(outline) >= LEAST:
                    lines.append(" ".join(f"{x!r} {y!r}" for x, y in outline))
    Path(target).write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
