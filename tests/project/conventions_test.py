# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Each convention is read and written in one file of src/formats (conventions_test.py ROOT).

1. Names that mark a convention stand in its file alone, and in conventions.cpp, which recognizes it.
2. Layers that compute include neither a reader nor a writer of netCDF, and none of src/formats.
3. Features of GeoJSON are begun in one file.
"""

import pathlib
import re
import sys

# By convention: the files that read and write it, and names that its files have and no others.
CONVENTIONS = {
    "UGRID": ("ugrid.cpp ugrid_triangles.cpp", ["face_node_connectivity", "face_coordinates", "edge_face_connectivity"]),
    "SCRIP": ("scrip.cpp", ["grid_corner_lon", "grid_corner_lat"]),
    "ESMF": ("esmf.cpp", ["nodeCoords", "elementConn", "centerCoords", "polybreak_value"]),
    "MPAS": ("mpas.cpp mpas_arrays.cpp mpas_lists.cpp", ["verticesOnCell", "edgesOnCell", "nEdgesOnCell", "kiteAreasOnVertex"]),
    "ICON": ("icon.cpp", ["vertex_of_cell"]),
    "OASIS": ("oasis.cpp", ['".msk"']),
    "Exodus": ("exodus.cpp", ["connect1", "elem_num_map", "global_id"]),
    "weights of ESMF": ("weights_esmf.cpp", ['"col"', '"n_s"']),
    "weights of SCRIP": ("weights_scrip.cpp weights_yac.cpp", ["src_address", "dst_address"]),  # YAC has its links
    "weights of YAC": ("weights_yac.cpp", ["yac weight file"]),
}
RECOGNIZES = "conventions.cpp"
COMPUTE = ["map", "interpolation", "overlay", "proximity", "meshing"]
FILES = re.compile(r'#include "(io/(netcdf|geojson|csv|npy)|formats/)')


def without_comments(path):
    """The code of a file."""
    return re.sub(r"//[^\n]*", "", path.read_text(encoding="utf-8"))


def problems(root):
    """One line for each violation."""
    sources = {path: without_comments(path) for path in sorted((root / "src").rglob("*")) if path.suffix in (".h", ".cpp")}
    for convention, (files, names) in CONVENTIONS.items():
        own = {root / "src/formats" / file for file in files.split()}
        for name in names:
            found = {path for path, text in sources.items() if name in text}
            if not found & own:
                yield f"{convention}: {name} is in none of its files"
            for path in sorted(found - own - {root / "src/formats" / RECOGNIZES}):
                yield f"{convention}: {path.relative_to(root)} has {name}"
    for path, text in sources.items():
        layer = path.relative_to(root / "src").parts[0]
        if layer in COMPUTE and FILES.search(path.read_text(encoding="utf-8")):
            yield f"{path.relative_to(root)} computes and includes files of a format"
    writers = [path.name for path, text in sources.items() if '"Feature"' in text and '"FeatureCollection"' not in text]
    writers = [name for name in writers if "items" not in name]
    if writers != ["geojson_writer.cpp"]:
        yield f"features of GeoJSON are begun in {writers}"


def main():
    found = list(problems(pathlib.Path(sys.argv[1])))
    print("\n".join(found) or "each convention has one place")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
