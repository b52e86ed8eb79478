# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the globes of the site with the tool, and the page that shows them: globes.py TOOL FOLDER GALLERY.md"""

import pathlib
import subprocess
import sys

STATIONS = "data/stations.csv"

# Name: title, words, the sites (a file, or what `rondel generate` takes), the options of `rondel plot`.
GLOBES = {
    "stations": (
        "Weather stations",
        "The Voronoi cells of 5,634 stations, colored by area. Some stations share a place: they are listed as duplicates.",
        STATIONS,
        "--show voronoi --fill area --view -60 35",
    ),
    "triangles": (
        "Their triangulation",
        "A triangle for every three stations whose circle has no other in it.",
        STATIONS,
        "--show delaunay --view 10 45",
    ),
    "circles": (
        "Circles and power cells",
        "Sites with a radius: the cells are power (Laguerre) cells, borders pass through the points in which circles meet. Hidden circles are paler.",
        "circles -n 60 --angle 25",
        "--radius radius --circles --show voronoi",
    ),
    "spiral": (
        "S_250",
        "A spiral of the paper by Caroli et al. with fans of very flat triangles.",
        "paper-s -n 250",
        "--show both --view 60 50",
    ),
    "fibonacci": (
        "The Fibonacci spiral",
        "5,000 sites with nearly equal distances. The cells' areas differ most at the poles.",
        "fibonacci -n 5000",
        "--show voronoi --fill area --no-sites --view 0 80",
    ),
    "grid": (
        "A grid of longitude and latitude",
        "Four sites on a circle everywhere, and both poles: all ties, all broken by one rule.",
        "lonlat-grid --rows 37 --columns 72",
        "--show delaunay --view 20 60",
    ),
    "clusters": (
        "Clusters",
        "Zoom in: each dark place is a thousand sites.",
        "cluster -n 20000",
        "--show voronoi --fill area --no-sites",
    ),
    "falling": (
        "A spiral that falls into the pole",
        "Down to 1e-15 of a radian, some nanometres on the Earth. Zoom in on the north pole.",
        "falling-spiral -n 400",
        "--show both --view 0 89",
    ),
    "patch": (
        "A patch seen from one side",
        "All sites within twenty degrees: what the center does not see are ghost faces.",
        "patch -n 800 --angle 20",
        "--show both",
    ),
}


def section(name, title, words):
    """A globe in a page, with a link to it alone."""
    return (
        f"\n## {title}\n\n{words}\n\n```{{raw}} html\n<div class=\"globe\"><iframe src=\"globes/{name}.html\" loading=\"lazy\" title=\"Globe: {title}\">"
        f"</iframe></div>\n<p><a href=\"globes/{name}.html\">In a window of its own</a></p>\n```\n"
    )


def main(tool, folder, gallery):
    folder.mkdir(parents=True, exist_ok=True)
    text = (
        "# Gallery\n\nEach picture is a page that `rondel plot` made: turn it, zoom, point at a site, switch triangles, cells and circles on and off. "
        "Each is one file that needs no server and no network.\n\n"
        "The sites of the first one can be dragged, added and removed ([how](docs/guide/globe.md#a-globe-to-play-with)); `scripts/build-js` makes it.\n"
    )
    text += section("play", "To play with", "Begin with another set of sites at the left, or drop a CSV file on it.")
    for name, (title, words, sites, options) in GLOBES.items():
        made, path = "", sites
        if sites != STATIONS:
            path = str(folder.parent.parent / f"{name}.csv")
            subprocess.run([tool, "generate", *sites.split(), "-o", path, "--quiet"], check=True)
            made = f"rondel generate {sites} -o {name}.csv\n"
        page = str(folder / f"{name}.html")
        subprocess.run([tool, "plot", path, "-o", page, "--quiet", *options.split()], check=True)
        shown = sites if sites == STATIONS else f"{name}.csv"
        text += section(name, title, words) + f"\n```sh\n{made}rondel plot {shown} {options} -o {name}.html\n```\n"
    gallery.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1], *(pathlib.Path(argument).resolve() for argument in sys.argv[2:4]))
