# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What mypy says of programs that use the package."""

import pathlib

import pytest

import rondel

PROGRAM = """
import io
import pathlib
import numpy as np
import rondel
import rondel.distributed
import rondel.mesh
import rondel.out_of_core

points = np.eye(3)
tri = rondel.delaunay(points)
reveal_type(tri.within([1.0, 0.0, 0.0], 0.1).size)
reveal_type(tri.within([[1.0, 0.0, 0.0]], 0.1).indptr.size)
tri.within(points[0], 0.1).size
sites = rondel.DynamicTriangulation(points)
reveal_type(sites.insert([1.0, 0.0, 0.0]))
reveal_type(sites.insert([[1.0, 0.0, 0.0]]).size)
reveal_type(tri.voronoi().areas.size)
reveal_type(rondel.SphericalVoronoi(points, copy=False).delaunay.npoints)
reveal_type(tri.to_geojson())
tri.voronoi().to_geojson(io.StringIO(), properties={"name": ["a", "b", "c"]})
tri.within([1.0, 0.0, 0.0])
rondel.delaunay(points, copies=True)
weights = tri.weights(points, method="linear")
reveal_type(weights.shape[0])
reveal_type(weights.indices.size)
reveal_type((weights @ points).size)
reveal_type(tri.interpolate(np.ones(3), points, outside="nearest").size)
reveal_type(tri.interpolate_winds(points[0], points[1], 0.0, 90.0)[0].size)
reveal_type(rondel.SphericalInterpolator((points[0], points[1]), np.ones(3))(0.0, 0.0).size)
reveal_type(tri.isolines(np.ones(3), 0.5).lines(0)[0].size)
reveal_type(tri.bands(np.ones(3), [0.5]).to_geojson())
tri.weights(points, method="spline")

path = pathlib.Path("sites.npy")
reveal_type(rondel.out_of_core.delaunay(path, "faces.npy", scratch=path, memory="2G"))
rondel.out_of_core.delaunay(path, "faces.npy", scratch=path, memory=2.5)

class Alone:
    rank = 0
    size = 1
    def allgather(self, message: bytes) -> list[bytes]:
        return [message]
    def alltoall(self, messages: list[bytes]) -> list[bytes]:
        return messages

part = rondel.distributed.delaunay(points, Alone(), model="weighted")
reveal_type(part)
reveal_type(part.faces.size)
reveal_type(part.num_faces)
reveal_type(rondel.distributed.delaunay_file(path, "faces.npy", neighbors=path).first_face)
reveal_type(rondel.distributed.DistributedError("rank 0, count: none").rank)
rondel.distributed.delaunay(points, "world")

reveal_type(rondel.mesh.from_points(tri, radius=2).cell_areas.size)
reveal_type(rondel.mesh.read(path))
reveal_type(rondel.mesh.scvt(100, fixed=[[0, 0, 1]], along=path).cull(inside=path).mesh)
reveal_type(rondel.mesh.scvt(100, density=lambda p: p[:, 2] ** 2 + 1).cull([0, 1]).cells.size)
rondel.mesh.scvt(100, density=2.0)
"""


PACKAGE = pathlib.Path(rondel.__file__).parent
CONFIG = pathlib.Path(__file__).parents[3] / "pyproject.toml"


@pytest.fixture(scope="module")
def check(tmp_path_factory):
    """A function that has mypy look at a path; what it knows of NumPy and others it learns once."""
    api = pytest.importorskip("mypy.api")
    if not (PACKAGE / "_core.pyi").exists():
        pytest.skip("needs the target rondel_python_stub")
    cache = tmp_path_factory.mktemp("cache")
    options = ["--config-file", str(CONFIG), "--cache-dir", str(cache)]
    return lambda path: api.run([*options, str(path)])


def test_programs_have_the_types_that_are_documented(check, tmp_path, monkeypatch):
    program = tmp_path / "program.py"
    program.write_text(PROGRAM, encoding="utf-8")
    monkeypatch.setenv("MYPYPATH", str(PACKAGE.parent))
    out, _, _ = check(program)
    said = out.replace("builtins.", "").splitlines()
    revealed = [line.split('"')[1] for line in said if "Revealed type" in line]
    assert revealed == [
        *["int"] * 6,
        "dict[str, Any]",
        *["int"] * 7,
        "dict[str, Any]",
        "rondel.out_of_core.Report",
        "rondel.distributed.DistributedTriangulation",
        *["int"] * 5,
        "rondel._voronoi_mesh.Mesh",
        "rondel._voronoi_mesh.Mesh",
        "int",
    ], out
    errors = [line.rpartition("[")[2] for line in said if "error:" in line]
    assert sorted(errors) == [
        "arg-type]",
        "arg-type]",
        "arg-type]",
        "arg-type]",
        "call-arg]",
        "call-overload]",
    ], out


def test_the_package_has_the_types_that_it_says(check):
    out, _, status = check(PACKAGE)
    assert status == 0, out
