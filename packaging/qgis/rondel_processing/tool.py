# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The tool rondel: where it is, how it is called, and the GeoJSON that it reads. Needs no QGIS."""

import json
import os
import shutil
import subprocess


class ToolError(Exception):
    """The tool is missing, was stopped or failed; the text is its last line."""


def find_tool(setting=""):
    """The path of the tool: the setting, the environment variable RONDEL_TOOL, or the first one in PATH.

    Raises ToolError, with what to do, if there is none.
    """
    for name in (setting, os.environ.get("RONDEL_TOOL", ""), "rondel"):
        found = shutil.which(name) if name else None
        if found:
            return found
        if name and name != "rondel":
            raise ToolError(f"{name} is not a program; it should be the tool rondel")
    raise ToolError(
        "the tool rondel was not found: 'pip install rondel' brings it; then set rondel/tool in the advanced settings,"
        " or RONDEL_TOOL, to its path"
    )


def run_tool(tool, arguments, is_stopped=lambda: False, tell=lambda line: None):
    """Runs the tool and tells each line that it prints. Raises ToolError if it fails, or if is_stopped() says so."""
    command = [str(tool), *map(str, arguments)]
    tell(" ".join(command))
    flags = getattr(subprocess, "CREATE_NO_WINDOW", 0)
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, text=True,
        encoding="utf-8", creationflags=flags,
    ) as process:
        lines = []
        while True:
            try:
                output, _ = process.communicate(timeout=0.2)
            except subprocess.TimeoutExpired:
                if is_stopped():
                    process.terminate()
                    raise ToolError("stopped") from None
                continue
            lines = output.splitlines()
            break
    for line in lines:
        tell(line)
    if process.returncode != 0:
        raise ToolError(lines[-1] if lines else f"the tool ended with status {process.returncode}")


def write_features(path, features):
    """Writes GeoJSON of pairs of a geometry, which may be None, and a dict of properties."""
    with open(path, "w", encoding="utf-8") as file:
        file.write('{"type": "FeatureCollection", "features": [\n')
        for i, (geometry, properties) in enumerate(features):
            feature = {"type": "Feature", "geometry": geometry, "properties": properties}
            file.write((",\n" if i else "") + json.dumps(feature, ensure_ascii=False, allow_nan=False))
        file.write("\n]}\n")


def delaunay(sites, output):
    """The arguments for triangles."""
    return ["delaunay", sites, "-o", output, "--quiet"]


def voronoi(sites, output, clip=None, group=None):
    """The arguments for cells: cut by the polygons of a file, joined where a column has the same text."""
    arguments = ["voronoi", sites, "-o", output, "--quiet", "--earth-radius", "6371.0088"]
    if clip:
        arguments += ["--clip", clip, "--invalid", "repair"]
    if group:
        arguments += ["--group", group]
    return arguments


METHODS = ("sibson", "linear", "nearest", "laplace", "hermite", "cubic")


def interpolate(sites, output, column, degrees, method, outside="nan"):
    """The arguments for values on a grid of cells of so many degrees."""
    return ["interpolate", sites, "--value", column, "--to", f"grid:{degrees:.12g}", "--method", method,
            "--outside", outside, "-o", output, "--quiet"]


def contours(sites, output, column, step=None, levels=(), bands=False):
    """The arguments for isolines, or the bands between them."""
    arguments = ["contours", sites, "--value", column, "-o", output, "--quiet"]
    arguments += ["--levels", ",".join(f"{level:.17g}" for level in levels)] if levels else ["--step", f"{step:.17g}"]
    return arguments + (["--bands"] if bands else [])
