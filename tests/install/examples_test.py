# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Installs the package, builds the examples against it alone, and compares what they print.

    examples_test.py CMAKE BUILD_FOLDER SOURCE_FOLDER COMPILER

The expected texts are in tests/install/expected, one for each example.
"""

import difflib
import pathlib
import shutil
import sys
import tempfile

from commands import run

ARGUMENTS = {"quick": [], "buffers": [], "cell_areas": ["data/stations.csv"], "circles": [], "constrained": [], "contours": [], "hull": [], "nearest": [], "ocean_mesh": [], "out_of_core": [], "regions": [], "regrid": [], "remap": [],
             "set_operations": [], "editing": [], "embedding": [], "stop": [], "c_interface": [], "c_polygons": [], "c_geometries": []}


def build_examples(cmake, build, source, compiler, work):
    """Copies the examples away from the source tree, so that nothing but the package is in reach."""
    run([cmake, "--install", build, "--prefix", work / "prefix"])
    shutil.copytree(source / "examples", work / "examples")
    run([cmake, "-S", work / "examples", "-B", work / "build", f"-DCMAKE_PREFIX_PATH={work}/prefix",
         f"-DCMAKE_CXX_COMPILER={compiler}", "-DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF"])
    run([cmake, "--build", work / "build"])


def difference(source, name, printed):
    """A diff between what an example printed and what it should print; empty when equal."""
    expected = (source / "tests/install/expected" / f"{name}.txt").read_text(encoding="utf-8")
    return "".join(
        difflib.unified_diff(
            expected.splitlines(True), printed.splitlines(True), f"expected/{name}.txt", "printed"
        )
    )


def main():
    cmake, build, source, compiler = sys.argv[1:]
    source = pathlib.Path(source)
    programs = {path.stem for path in (source / "examples").glob("*.c*")}
    if programs != set(ARGUMENTS):
        sys.exit(f"the examples are {sorted(programs)}, the test knows {sorted(ARGUMENTS)}")
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        build_examples(cmake, build, source, compiler, work)
        found = "".join(
            difference(source, name, run([work / "build" / name, *arguments], cwd=source))
            for name, arguments in ARGUMENTS.items()
        )
    if found:
        sys.exit(found)


if __name__ == "__main__":
    main()
