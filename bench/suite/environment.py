# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Where and with what the figures were measured."""

import datetime
import json
import os
import platform
import subprocess

from .runs import machine_memory
from .settings import ROOT
from .tables import Table

PACKAGES = {"CGAL": "libcgal-dev", "Qhull": "libqhull-dev", "STRIPACK in NCAR's ngmath":
            "libncarg-dev", "nanoflann": "libnanoflann-dev", "oneTBB": "libtbb-dev",
            "SciPy": "python3-scipy", "Node.js": "nodejs"}


def _output(*command):
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=ROOT)
    except OSError:
        return ""
    return done.stdout.strip() if done.returncode == 0 else ""


def processor(path="/proc/cpuinfo"):
    """Its name, its family and model, which tell more where the name is that of many, and how wide its
    vectors are."""
    with open(path, encoding="utf-8") as file:
        lines = (line.partition(":") for line in file)
        facts = {key.strip(): value.strip() for key, _, value in lines}
    if "model name" not in facts:
        return platform.machine()
    flags = facts.get("flags", "").split()
    widest = [flag for flag in ("avx2", "avx512vl", "avx512_vbmi2") if flag in flags]
    numbers = ", ".join(f"{key} {facts[key]}" for key in ("cpu family", "model") if key in facts)
    return f"{facts['model name']} ({', '.join(filter(None, [numbers, *widest[-1:]]))})"


def _cache_variable(settings, name):
    with open(settings.programs.parent / "CMakeCache.txt", encoding="utf-8") as file:
        return next((line.split("=", 1)[1].strip() for line in file
                     if line.startswith(name + ":")), "")


def _npm_version(settings):
    package = settings.node_packages / "node_modules" / "d3-geo-voronoi" / "package.json"
    return json.loads(package.read_text())["version"] if package.exists() else ""


def table(settings):
    changed = " and changes" if _output("git", "status", "--porcelain", "-uno") else ""
    compiler = _output(_cache_variable(settings, "CMAKE_CXX_COMPILER"), "--version")
    versions = {name: _output("dpkg-query", "-W", "-f", "${Version}", package)
                for name, package in PACKAGES.items()}
    versions["d3-geo-voronoi"] = _npm_version(settings)
    rows = [
        ["date", datetime.date.today().isoformat()],
        ["commit", _output("git", "rev-parse", "--short", "HEAD") + changed],
        ["processor", f"{processor()}, {len(os.sched_getaffinity(0))} cores"],
        ["memory", f"{machine_memory() / 2**30:.0f} GiB"],
        ["system", platform.platform()],
        ["compiler", compiler.splitlines()[0] if compiler else "unknown"],
        ["options", _cache_variable(settings, "CMAKE_BUILD_TYPE") + ", "
         + _cache_variable(settings, "CMAKE_CXX_FLAGS_RELEASE")],
        *([name, version] for name, version in versions.items() if version),
    ]
    return Table("Machine and versions", ["what", "which"], rows)
