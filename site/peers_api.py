# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The public names of peers beside ours: site/coming-from/api.md.

    peers_api.py check [PEER]...     compares site/peers_api.toml with the peers that are installed; all by default
    peers_api.py page                prints the page, after the same checks

The table has a row for each public name of a peer, found by this script, and for no other; names of ours are looked
up in the package. A name without a counterpart says why. Peers are found where scripts/site puts them (RONDEL_ROOT,
RONDEL_SITE_NODE), SciPy by import; a peer that is not there is not checked, and the page says so.
"""

import ast
import importlib
import inspect
import json
import os
import pathlib
import re
import subprocess
import sys
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent
CGAL = pathlib.Path("/usr/include/CGAL")


class Missing(Exception):
    """A peer that is not installed."""


def public(names):
    return sorted({name for name in names if not name.startswith("_")})


def scipy():
    """The parameters and public members of SciPy's class; attributes as its documentation lists them."""
    try:
        from scipy.spatial import SphericalVoronoi
    except ImportError as error:
        raise Missing("SciPy") from error
    parameters = [f"SphericalVoronoi({name}=)" for name in inspect.signature(SphericalVoronoi).parameters]
    attributes = re.findall(r"^    (\w+) : ", inspect.getdoc(SphericalVoronoi).split("Attributes\n")[1].split("\n\n")[0].replace("\n", "\n    "), re.M)
    members = public([name for name in vars(SphericalVoronoi)])
    return sorted(parameters) + public([*attributes, *members])


def xesmf():
    """The public names of xESMF's wheel, read as text: importing it needs ESMF."""
    for folder in (ROOT / "build/site-peers", *map(pathlib.Path, filter(None, [os.environ.get("RONDEL_PEERS")]))):
        source = folder / "xesmf/frontend.py"
        if source.exists():
            break
    else:
        raise Missing("xESMF")
    classes = {node.name: node for node in ast.parse(source.read_text(encoding="utf-8")).body if isinstance(node, ast.ClassDef)}
    names = ["SpatialAverager"]
    for name in ("BaseRegridder", "Regridder"):
        for node in classes[name].body:
            if isinstance(node, ast.FunctionDef) and node.name == "__init__":
                arguments = [argument.arg for argument in (*node.args.args[1:], *node.args.kwonlyargs)]
                names += [f"Regridder({argument}=)" for argument in arguments if argument not in ("grid_in", "grid_out")]
            elif isinstance(node, ast.FunctionDef):
                names += [f"Regridder.{node.name}"] if not node.name.startswith("_") else []
                if node.name == "__call__":
                    names += [f"Regridder()({argument.arg}=)" for argument in node.args.args[1:]]
    util = ast.parse((source.parent / "util.py").read_text(encoding="utf-8"))
    names += [f"util.{node.name}" for node in util.body if isinstance(node, ast.FunctionDef) and not node.name.startswith("_")]
    return sorted(set(names))


D3 = """
const d3 = await import("d3-geo-voronoi");
const names = [];
const places = [[0, 0], [90, 0], [180, 0], [-90, 0], [0, 90], [0, -90]];
const list = (prefix, value) => Object.keys(value).filter((k) => !k.startsWith("_")).forEach((k) => names.push(prefix + k));
list("", d3);
list("geoVoronoi().", d3.geoVoronoi(places));
list("geoDelaunay().", d3.geoDelaunay(places));
list("geoContour().", d3.geoContour());
console.log(JSON.stringify(names));
"""


def d3():
    """The names that d3-geo-voronoi exports, and those of what its functions return."""
    folder = os.environ.get("RONDEL_SITE_NODE", str(ROOT / "build/site-node"))
    if not pathlib.Path(folder, "node_modules/d3-geo-voronoi").exists():
        raise Missing("d3-geo-voronoi")
    command = ["node", "--input-type=module", "-e", D3]
    return sorted(json.loads(subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True).stdout))


def cgal():
    """The public functions of CGAL's class for Delaunay triangulations on the sphere and of its base, by their headers."""
    names = []
    for header in ("Triangulation_on_sphere_2.h", "Delaunay_triangulation_on_sphere_2.h"):
        if not (CGAL / header).exists():
            raise Missing("CGAL")
        text = re.sub(r"//[^\n]*|/\*.*?\*/", "", (CGAL / header).read_text(encoding="utf-8"), flags=re.S)
        body = text[re.search(r"^class \w+\s*(?::[^{]*)?\{", text, re.M).end():]
        body = body[: re.search(r"^\};", body, re.M).start()]
        # Bodies of functions go, so that what they call is not taken for a declaration.
        while (shorter := re.sub(r"\{[^{}]*\}", ";", body)) != body:
            body = shorter
        parts = re.split(r"^\s*(public|protected|private)\s*:", body, flags=re.M)
        shown = "".join(part for kind, part in zip(["private", *parts[1::2]], parts[::2]) if kind == "public")
        names += re.findall(r"^ {2,4}(?:\w[\w:<>,&*\s]*?[\s&*])?(\w+)\s*\((?![*)]?\*)", shown, re.M)
    skipped = {"CGAL_precondition", "CGAL_assertion", "CGAL_triangulation_precondition", "if", "return", "for", "while", "operator", "decltype"}
    return sorted({name for name in names if name not in skipped and not name.lower().endswith("triangulation_on_sphere_2")})


PEERS = {"scipy": scipy, "xesmf": xesmf, "d3": d3, "cgal": cgal}


def table():
    return tomllib.loads((HERE / "peers_api.toml").read_text(encoding="utf-8"))


def exists(name):
    """Whether the package has what a row names, such as rondel.SphericalVoronoi.areas."""
    parts = name.split(".")
    found = importlib.import_module(parts[0])
    for k, part in enumerate(parts[1:], 1):
        if not hasattr(found, part):
            if inspect.ismodule(found):
                try:
                    found = importlib.import_module(".".join(parts[: k + 1]))
                    continue
                except ImportError:
                    return False
            # Attributes that exist in objects alone are documented in the class.
            documented = re.search(rf"^\s*[\w, ]*\b{part}\b[\w, ]* : ", inspect.getdoc(found) or "", re.M)
            return documented is not None and k == len(parts) - 1
        found = getattr(found, part)
    return True


def faults(peer):
    """What is wrong with the rows of a peer: (missing, superfluous, ours that do not exist)."""
    rows = {name: row for names, row in table()[peer]["names"].items() for name in names.split(", ")}
    found = PEERS[peer]()
    ours = {name for row in rows.values() for name in re.findall(r"`(rondel(?:\.\w+)+)`", row)}
    unknown = {name for name in ours if not exists(name)}
    if peer == "cgal":
        headers = "".join(path.read_text(encoding="utf-8") for path in sorted((ROOT / "include/rondel").glob("*.h")))
        words = {word for row in rows.values() for quoted in re.findall(r"`(\w[\w:]*)(?:\(.*?\))?`", row) for word in quoted.split("::")}
        unknown |= {word for word in words - {"rondel", "vertex_neighbor_vertices"} if not re.search(rf"\b{word}\b", headers)}
    return sorted(set(found) - set(rows)), sorted(set(rows) - set(found)), sorted(unknown)


def check(peers):
    """Prints what is wrong; the number of peers that were compared, or None if something is wrong."""
    compared, is_right = 0, True
    for peer in peers:
        try:
            missing, superfluous, unknown = faults(peer)
        except Missing as error:
            print(f"{error} is not installed: not compared", file=sys.stderr)
            continue
        compared += 1
        for what, names in (("no row for", missing), ("rows for what is not there:", superfluous), ("we have no", unknown)):
            if names:
                is_right = False
                print(f"{peer}: {what} {', '.join(names)}", file=sys.stderr)
    return compared if is_right else None


def code(names):
    return ", ".join(f"`{name}`" for name in names.split(", "))


def page():
    lines = ["# Tables of names", "", "Each public name of a peer, found by a script, and ours. Where we have none, the row says why.", ""]
    for peer, about in table().items():
        rows = about["names"]
        counts = [len(names.split(", ")) for names in rows]
        without = sum(n for n, row in zip(counts, rows.values(), strict=True) if row.startswith("no counterpart"))
        lines += [f"({peer})=", f"## {about['title']}", "", f"{about['version']}: {sum(counts)} names, {without} of them without a counterpart. {about['words']}".rstrip(), ""]
        lines += ["| theirs | ours |", "| --- | --- |", *(f"| {code(names)} | {row} |" for names, row in rows.items()), ""]
    return "\n".join(lines)


def main(arguments):
    if not arguments or arguments[0] not in ("check", "page"):
        print(__doc__.strip().split("\n\n")[1], file=sys.stderr)
        return 2
    if check(arguments[1:] or PEERS) is None:
        return 1
    if arguments[0] == "page":
        print(page())
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
