# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Files of polygons, by the tool or by the Python package; each function returns what was wrong, or nothing."""

import csv
import pathlib
import subprocess

import numpy as np


# Kinds of sites that take no seed.
NOT_RANDOM = {
    "fibonacci",
    "lonlat-grid",
    "grid",
    "paper-s",
    "icosahedral",
    "healpix",
    "reduced-gaussian",
    "cubed-sphere",
}

class Tool:
    """Runs the tool in a folder, once for each file."""

    def __init__(self, tool, folder):
        self.tool = tool.resolve()
        self.folder = pathlib.Path(folder)

    def call(self, *arguments):
        done = subprocess.run(
            [self.tool, *map(str, arguments), "--quiet"],
            cwd=self.folder,
            capture_output=True,
            text=True,
            check=False,
        )
        return (done.stderr.strip() or f"status {done.returncode}") if done.returncode else ""

    def run(self, *arguments):
        return self.call(*arguments, "--threads", "1")

    def kinds(self):
        """All that the tool can generate, as its help lists them."""
        text = subprocess.run(
            [self.tool, "generate", "--help"], capture_output=True, text=True, check=True
        ).stdout
        kinds = []
        is_list = False
        for line in text.splitlines():
            if line and not line.startswith(" "):
                is_list = line.startswith(("Kinds:", "Sets of", "Hostile"))
            elif is_list and line.startswith("  ") and not line.startswith("   "):
                kinds.append(line.split()[0])
        return kinds

    def generate(self, name, kind, seed, *arguments):
        of_seed = () if kind in NOT_RANDOM else ("--seed", seed)
        return self.call("generate", kind, *of_seed, "-o", name, *arguments)

    def write(self, command, out, tolerance, *arguments):
        more = ["--tolerance", tolerance, "--threads", "1"]
        return self.call(command, *arguments, "-o", out, *more)

    def voronoi(self, sites, out, tolerance, model="projected"):
        return self.write("voronoi", out, tolerance, sites, "--model", model)

    def delaunay(self, sites, out):
        return self.call("delaunay", sites, "-o", out)

    def bands(self, sites, out, tolerance, levels):
        what = ["--value", "value", f"--levels={','.join(map(repr, levels))}", "--bands"]
        return self.write("contours", out, tolerance, sites, *what)

    def clip(self, sites, out, tolerance, model, regions, is_grouped):
        what = ["--model", model, "--clip", regions]
        what += ["--group", "owner"] if is_grouped else []
        return self.write("voronoi", out, tolerance, sites, *what)

    def cut(self, sites, out, tolerance, model, regions, owners, edges, is_grouped):
        """Cells are cut where the owners of the regions change, which are their property `owner`."""
        what = ["--model", model, "--clip", regions, "--clip-value", "owner", "--edges", edges]
        what += ["--group", "owner"] if is_grouped else []
        return self.write("voronoi", out, tolerance, sites, *what)


class Bindings(Tool):
    """The same in this process; only sites come from the tool."""

    def __init__(self, tool, folder):
        super().__init__(tool, folder)
        import rondel

        self.rondel = rondel
        self.made = {}

    def once(self, name, make):
        """What `make` makes of the content of a file, until that changes."""
        content = (self.folder / name).read_text("utf-8")
        if name not in self.made or self.made[name][0] != content:
            self.made[name] = content, make(content)
        return self.made[name][1]

    def triangulation(self, sites, model="projected"):
        made = self.once(sites, self.read_sites)[0]
        if model not in made:
            made[model] = self.rondel.delaunay(made["points"], model, threads=1)
        return made[model]

    def columns(self, sites):
        return self.once(sites, self.read_sites)[1:]

    def read_sites(self, content):
        rows = list(csv.DictReader(content.splitlines()))
        names = ("lon", "lat") if "lon" in rows[0] else ("x", "y", "z")
        places = np.array([[float(row[name]) for name in names] for row in rows])
        made = {"points": places}
        if len(names) == 2:
            made["projected"] = self.rondel.delaunay_lonlat(*places.T, threads=1)
        return made, [row.get("value") for row in rows], [row.get("owner") for row in rows]

    def cell_set(self, regions, **rules):
        read = self.rondel.CellSet.read
        return self.once(regions, lambda _: read(self.folder / regions, threads=1, **rules))

    def written(self, out, make, **options):
        try:
            make().to_geojson(self.folder / out, **options)
        except (ValueError, OSError, RuntimeError) as error:
            return str(error)
        return ""

    def voronoi(self, sites, out, tolerance, model="projected"):
        def make():
            return self.triangulation(sites, model).voronoi()

        return self.written(out, make, tolerance_deg=tolerance)

    def delaunay(self, sites, out):
        return self.written(out, lambda: self.triangulation(sites))

    def bands(self, sites, out, tolerance, levels):
        def make():
            made = self.triangulation(sites)
            values = [float(value or "nan") for value in self.columns(sites)[0]]
            return made.bands(values, levels, threads=1)

        return self.written(out, make, tolerance=tolerance)

    def clip(self, sites, out, tolerance, model, regions, is_grouped):
        def make():
            cells = self.triangulation(sites, model).voronoi()
            clipped = cells.clip(self.cell_set(regions), threads=1)
            return clipped.dissolve(self.columns(sites)[1], threads=1) if is_grouped else clipped

        return self.written(out, make, tolerance_deg=tolerance)

    def cut(self, sites, out, tolerance, model, regions, owners, edges, is_grouped):
        def make():
            cells = self.triangulation(sites, model).voronoi()
            within = self.cell_set(regions, edges=edges, overlap="error")
            pieces = cells.clip(within, values=owners, threads=1)
            if not is_grouped:
                return pieces
            names = self.columns(sites)[1]
            groups = [(names[s], v) for s, v in zip(pieces.labels, pieces.values)]
            return pieces.dissolve(groups, threads=1)

        return self.written(out, make, tolerance_deg=tolerance)
