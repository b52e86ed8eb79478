# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Rondel and the programs with which it is compared: how each is run, and what it must find."""

import dataclasses
import functools
import importlib.util
import pathlib
import shutil
import sys

from .runs import machine_memory

COMPARE = pathlib.Path(__file__).resolve().parent.parent / "compare"


@dataclasses.dataclass(frozen=True)
class Peer:
    label: str
    program: str  # in the folder of programs, or a script in bench/compare
    arguments: tuple = ()
    model: str = "projected"  # whose vertices it has to find
    color: str = "black"
    line: str = "-"

    @property
    def is_script(self):
        return self.program.endswith((".py", ".mjs"))


RONDEL = Peer("Rondel, projected", "rondel_bench", ("projected",), color="#c00000")
RONDEL_WEIGHTED = Peer("Rondel, weighted", "rondel_bench", ("weighted",), "weighted", "#c00000",
                       "--")
CGAL_GIVEN = Peer("CGAL on the sphere, points as given", "cgal_bench", ("kernel",), "weighted",
                  "#0050a0", "--")
CGAL_PROJECTED = Peer("CGAL on the sphere, projected", "cgal_bench", ("projection",),
                      color="#0050a0")
STRIPACK = Peer("STRIPACK, csstrid", "stripack_bench", ("csstrid",), color="#008040")
STRIPACK_TRMESH = Peer("STRIPACK, trmesh alone", "stripack_bench", ("trmesh",), color="#008040",
                       line="--")
QHULL = Peer("Qhull", "qhull_bench", (), "weighted", "#806000")

PEERS = [
    RONDEL,
    RONDEL_WEIGHTED,
    CGAL_PROJECTED,
    CGAL_GIVEN,
    Peer("CGAL Delaunay in space, with the center", "cgal_delaunay3_bench", (), "weighted",
         "#00a0c0"),
    Peer("CGAL convex hull", "cgal_hull_bench", (), "weighted", "#00a0c0", "--"),
    QHULL,
    Peer("SciPy SphericalVoronoi", "scipy_bench.py", (), "weighted", "#806000", "--"),
    STRIPACK,
    STRIPACK_TRMESH,
    Peer("d3-geo-voronoi", "d3_bench.mjs", (), "projected", "#a000a0"),
    Peer("Triangle, planar projection (a hint)", "triangle_bench.py", (), "projected", "#808080",
         ":"),
]


def command(peer, settings, kind, n, file):
    """`file` holds the sites of the same input as .npy."""
    if peer.program.endswith(".mjs"):
        # By itself Node.js stops at 4 GB.
        return ["node", f"--max-old-space-size={machine_memory() * 3 // 4 // 2**20}",
                COMPARE / peer.program, file, settings.node_packages]
    if peer.program.endswith(".py"):
        return [sys.executable, COMPARE / peer.program, file]
    return [settings.programs / peer.program, kind, n, *peer.arguments]


def missing(peer, settings):
    """Why a peer cannot be run; empty if it can."""
    if peer.program == "d3_bench.mjs":
        if not shutil.which("node"):
            return "node is not installed"
        package = settings.node_packages / "node_modules" / "d3-geo-voronoi"
        return "" if package.exists() else "the npm package d3-geo-voronoi is not installed"
    if peer.is_script:
        module = {"scipy_bench.py": "scipy", "triangle_bench.py": "triangle"}[peer.program]
        return "" if importlib.util.find_spec(module) else f"no Python module {module}"
    is_built = (settings.programs / peer.program).exists()
    return "" if is_built else f"{peer.program} was not built: its library is not installed"


@functools.cache
def available(settings):
    """The peers that can be run; says which cannot."""
    there = []
    for peer in PEERS:
        reason = missing(peer, settings)
        if reason:
            print(f"skipped: {peer.label}: {reason}", file=sys.stderr)
        else:
            there.append(peer)
    return there
