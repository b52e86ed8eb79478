# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Clients of the installed package that do not use CMake, of a plugin, and of the shared libraries.

    clients_test.py pkg_config|c|components|distributed|geo|plugin|shared CMAKE BUILD_FOLDER SOURCE_FOLDER COMPILER LIBRARIES...

Each compiles client.cpp, those in C examples/c_interface.c, c_polygons.c and c_geometries.c, those of other libraries theirs, as geo/geo.cpp, and
compares what it prints. The libraries are those of rondel, rondel::geo and rondel::distributed.
"""

import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

from commands import run


# What rondel::geo uses of the core, and rondel::distributed of both.
USED_ABOVE = re.compile(
    r"rondel::(api::(build_parts|make_triangulation|prove_delaunay|require_(delaunay|unchanged_faces)|validate|validate_queries)|bulk::(AllSites|Bucket|join_buckets|triangulate_bucket)"
    r"|dynamic::(Places|Renumbering|live_sites|make_build)"
    r"|formats::regrid_by_ranks|dual::((areas|circumcenters)_within|exact_normal|exact_projected_difference|exact_weights|SplitSites)|io::(AtomicFile|BadValue|CsvRecords|FileBytes|Netcdf\w+|NpyRows|Zip\w+|has_zip_member|remark_on_units|require_o(ne_place|rder)|append_(csv_field|number)|column_names|columns_of_csv|csv_of|find_(attribute|column)|full_name|in_quotes|make_npy_header|netcdf_text|open_replacement|parse_n(py_header|umber)|read_polygon_features|require_different_names|shape_(of_grid|text)|table_text|throw_unknown_ending|trim|zip_member|replaced_by|temporary_name|write_in_parallel|ValueRules|coordinate_evidence|default_fill|degrees_of|has_netcdf_ending|header_of|headers_of|in_order|is_connectivity|is_known_name|is_netcdf|lower_case|meant_numbers|places_of|transposed|with_kind|without_blanks)|kernel::(find_span|insertion_order)|map::(area_on_left|is_clockwise|is_surely_larger|line_parts|lonlat_of|region_polygons|valid_regions)|overlay::(cells_in|with_outside)|order::(place_keys?|radix_sort|spatial_order|SpatialIndex)|predicates::directions?|query::(Built|Engine|order_ties_by_place)|topology::(flat_pair|star))\b|rondel::api::validate_some"
)

# What the client of rondel::geo prints.
FROM_GEO = "mean, an error\nmesh, an error\npage, an error\n"


class Client:
    """The arguments of this program, and a folder to work in."""

    def __init__(self, work, cmake, build, source, compiler, *libraries):
        self.work = work
        self.cmake = cmake
        self.build = build
        self.source = pathlib.Path(source)
        self.compile = [compiler, "-std=c++20", "-Wall", "-Wextra", "-Werror"]
        self.libraries = [pathlib.Path(library) for library in libraries]
        self.expected = f"{(self.source / 'VERSION').read_text().strip()}: 8 faces, 2 errors\n"

    def file(self, name):
        """A source of this test."""
        return self.source / "tests/install" / name

    def package_flags(self, package="rondel-geo"):
        """What pkg-config says of an installed package."""
        run([self.cmake, "--install", self.build, "--prefix", self.work / "prefix"])
        folders = {path.parent for path in (self.work / "prefix").rglob("rondel*.pc")}
        environment = {**os.environ, "PKG_CONFIG_PATH": ":".join(map(str, folders))}
        return shlex.split(
            run(["pkg-config", "--cflags", "--libs", package], env=environment)
        )

    def expect(self, printed, times=1):
        """Ends the test unless the client printed what it should."""
        if printed != times * self.expected:
            sys.exit(f"printed {printed!r}, expected {times} times {self.expected!r}")

    def pkg_config(self):
        """A program that knows the package by pkg-config alone."""
        run([*self.compile, self.file("client.cpp"), "-o", self.work / "client", *self.package_flags()])
        self.expect(run([self.work / "client"]))

    def c(self):
        """C programs that know the package by pkg-config alone."""
        flags = self.package_flags("rondel-c")
        folders = [flag[2:] for flag in flags if flag.startswith("-L")]
        for name in ("c_interface", "c_polygons", "c_geometries"):
            run(["cc", "-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", self.source / f"examples/{name}.c",
                 "-o", self.work / "client", *flags, *(f"-Wl,-rpath,{folder}" for folder in folders)])
            self.expected = self.file(f"expected/{name}.txt").read_text(encoding="utf-8")
            self.expect(run([self.work / "client"]))

    def geo(self):
        """A program that applies weights and makes a mesh and a page, by pkg-config and by CMake."""
        self.of_library("geo", FROM_GEO)

    def distributed(self):
        """A program that triangulates by way of files, by pkg-config and by CMake."""
        self.of_library("distributed", "8 faces, 1 error\n")

    def components(self):
        """Components that the package has are found, and others named."""
        run([self.cmake, "--install", self.build, "--prefix", self.work / "prefix"])
        for components, expected in (("rondel geo distributed c", "found 1"),
                                     ("geo sphere torus", "no component sphere, torus; its components are rondel, geo")):
            folder = self.work / ("known" if expected.startswith("found") else "unknown")
            folder.mkdir()
            (folder / "CMakeLists.txt").write_text(
                "cmake_minimum_required(VERSION 3.25)\nproject(client LANGUAGES CXX)\n"
                f"find_package(rondel REQUIRED COMPONENTS {components})\n"
                'message(STATUS "found ${rondel_FOUND}")\n', encoding="utf-8")
            done = subprocess.run([self.cmake, "-S", folder, "-B", folder / "build", f"-DCMAKE_PREFIX_PATH={self.work}/prefix",
                                   f"-DCMAKE_CXX_COMPILER={self.compile[0]}", "-DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF"],
                                  capture_output=True, text=True, check=False)
            said = " ".join((done.stdout + done.stderr).split())
            if expected not in said or (done.returncode == 0) != expected.startswith("found"):
                sys.exit(f"{components}: {said}")

    def of_library(self, name, expected):
        """The client of one library, which has a folder."""
        self.expected = expected
        flags = self.package_flags(f"rondel-{name}")
        run([*self.compile, self.file(f"{name}/{name}.cpp"), "-o", self.work / "client", *flags])
        self.expect(run([self.work / "client"]))
        run([self.cmake, "-S", self.file(name), "-B", self.work / "build", f"-DCMAKE_PREFIX_PATH={self.work}/prefix",
             f"-DCMAKE_CXX_COMPILER={self.compile[0]}", "-DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF"])
        run([self.cmake, "--build", self.work / "build"])
        self.expect(run([self.work / "build" / name]))

    def plugin(self):
        """The static libraries within a plugin, which is loaded and unloaded."""
        plugin = self.work / "plugin.so"
        run([*self.compile, "-DRONDEL_TEST_PLUGIN", "-fPIC", "-shared", self.file("client.cpp"),
             "-o", plugin, *self.package_flags()])
        run([*self.compile, self.file("host.cpp"), "-o", self.work / "host", "-ldl"])
        self.expect(run([self.work / "host", plugin]), times=2)

    def shared(self):
        """The shared libraries: what they show, and a program that links them."""
        for source, expected in (("client.cpp", self.expected), ("distributed/distributed.cpp", "8 faces, 1 error\n"),
                                 ("geo/geo.cpp", FROM_GEO)):
            paths = [f"-Wl,-rpath,{library.parent}" for library in self.libraries]
            run([*self.compile, self.file(source), "-o", self.work / "client",
                 f"-I{self.source}/include", f"-I{self.build}/include", *reversed(self.libraries), *paths])
            self.expected = expected
            self.expect(run([self.work / "client"]))
        # These show what libraries above them use.
        layers = set((self.source / "src/LAYERS").read_text(encoding="utf-8").split()) - {"system", "exact"}
        private = re.compile(rf"\brondel::({'|'.join(sorted(layers))})::")
        public = ("rondel::delaunay(", "rondel::read_sites(", "rondel::delaunay_file(")
        for library, known in zip(self.libraries, public, strict=True):
            names = run(["nm", "--dynamic", "--defined-only", "--demangle", library])
            shown = [line for line in names.splitlines() if private.search(line.partition("(")[0])]
            strange = [line for line in shown if not USED_ABOVE.search(line)]
            if strange or known not in names:
                sys.exit(f"{library} shows\n" + "\n".join(strange[:20]))


def main():
    kind, *arguments = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        getattr(Client(pathlib.Path(folder), *arguments), kind)()


if __name__ == "__main__":
    main()
