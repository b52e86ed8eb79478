# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Meshes of models."""

import warnings

import numpy as np
import pytest

import rondel
import rondel.mesh


def sites(n=300, seed=1):
    return np.random.default_rng(seed).normal(size=(n, 3))


def test_arrays_are_those_of_the_diagram():
    points = sites()
    tri = rondel.delaunay(points)
    mesh = rondel.mesh.from_points(tri, radius=3)
    assert np.allclose(mesh.points, 3 * points / np.linalg.norm(points, axis=1)[:, None])
    assert np.allclose(mesh.cell_areas, 9 * tri.voronoi().areas, rtol=1e-13)
    assert (mesh.cells_on_vertex == tri.simplices).all()
    assert sorted(map(tuple, mesh.cells_on_edge)) == sorted(map(tuple, tri.edges))
    a, b = (mesh.points[mesh.cells_on_edge[:, k]] / 3 for k in (0, 1))
    assert np.allclose(mesh.cell_distances, 3 * np.arccos((a * b).sum(axis=1)), rtol=1e-9)
    assert mesh.offsets[-1] == 2 * len(mesh.edge_points)
    assert mesh.density.min() == mesh.density.max() == 1
    with pytest.raises(ValueError, match="read-only"):
        mesh.cell_areas[0] = 1


def test_weights_are_antisymmetric():
    mesh = rondel.mesh.from_points(sites())
    indptr, indices, data = mesh.tangential_weights
    row = np.repeat(np.arange(len(indptr) - 1), np.diff(indptr))
    scaled = data * mesh.cell_distances[row] / mesh.vertex_distances[indices]
    found = {(i, j): w for i, j, w in zip(row, indices, scaled, strict=True)}
    assert all(abs(w + found[j, i]) < 1e-12 for (i, j), w in found.items())


def test_files_come_back(tmp_path):
    density = np.linspace(0.1, 1, 300)
    mesh = rondel.mesh.from_points(sites(), density=density)
    mesh.to_mpas(tmp_path / "m.nc", graph=tmp_path / "graph.info", kind="cdf2", threads=1)
    with pytest.raises(ValueError, match="graph is the file of path"):
        mesh.to_mpas(tmp_path / "m.nc", graph=tmp_path / "." / "m.nc")
    again = rondel.mesh.read(tmp_path / "m.nc")
    assert (again.kite_areas == mesh.kite_areas).all()
    assert (again.density == density).all()
    assert (tmp_path / "graph.info").read_text().startswith(f"300 {len(mesh.edge_points)}\n")
    for name in ("ugrid", "scrip", "esmf", "exodus"):
        getattr(mesh, f"to_{name}")(tmp_path / f"{name}.nc")
    for name in ("ugrid", "scrip", "esmf"):
        assert np.allclose(rondel.mesh.read(tmp_path / f"{name}.nc").cell_areas, mesh.cell_areas)
    with pytest.raises(FileNotFoundError):
        mesh.to_mpas(tmp_path / "none.nc", graph=tmp_path / "nowhere" / "graph.info")
    assert not (tmp_path / "none.nc").exists()
    with pytest.raises(OSError, match=r"exodus\.nc: Exodus: the file has no centers of cells"):
        rondel.mesh.read(tmp_path / "exodus.nc")
    # Its blocks have the cells in another order.
    areas = rondel.CellSet.read(tmp_path / "exodus.nc").areas
    assert np.allclose(np.sort(areas), np.sort(mesh.cell_areas))


@pytest.mark.parametrize(
    ("name", "row"),
    [("verticesOnCell", "cell"), ("cellsOnCell", "cell"), ("edgesOnVertex", "vertex")],
)
def test_lists_that_do_not_fit_are_told_and_made_again(tmp_path, name, row):
    netcdf = pytest.importorskip("netCDF4")
    mesh = rondel.mesh.from_points(sites())
    mesh.to_mpas(tmp_path / "mesh.nc", kind="nc4")
    with netcdf.Dataset(tmp_path / "mesh.nc", "a") as file:
        rows = file[name][:]
        first = rows[7].copy()
        rows[7, :3] = first[[1, 2, 0]] if row == "vertex" else first[:3]  # begins elsewhere
        file[name][:] = rows
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        rondel.mesh.read(tmp_path / "mesh.nc")
    for bad in (-5, 0, 99_999, rows[250, 0]):
        with netcdf.Dataset(tmp_path / "mesh.nc", "a") as file:
            rows[7, 1] = bad
            file[name][:] = rows
        with pytest.warns(UserWarning, match=f'"{name}" of {row} 7 does not fit to the cells and'):
            again = rondel.mesh.read(tmp_path / "mesh.nc")
        assert (again.vertices_on_cell == mesh.vertices_on_cell).all()


@pytest.mark.parametrize("form", ["mpas", "ugrid", "scrip", "esmf", "exodus"])
def test_files_have_the_kind_that_is_named(tmp_path, form):
    mesh = rondel.mesh.from_points(sites())
    write = getattr(mesh, f"to_{form}")
    for kind, magic in (("cdf2", b"CDF\2"), ("cdf5", b"CDF\5"), (None, b"CDF\5")):
        write(tmp_path / "m.nc", kind=kind)
        assert (tmp_path / "m.nc").read_bytes()[:4] == magic
    for kind in ("cdf5", "cdf2"):
        with pytest.raises(ValueError, match=rf"kind '{kind}' contradicts the name '.*\.nc4'"):
            write(tmp_path / "classic.nc4", kind=kind)
    for kind in ("hdf5", "by_name", "netcdf4"):
        with pytest.raises(ValueError, match=f"kind is '{kind}', which is none of 'nc4', "):
            write(tmp_path / "m.nc", kind=kind)
    assert not (tmp_path / "classic.nc4").exists()


@pytest.mark.parametrize(("name", "kind"), [("m.nc", "nc4"), ("m.nc4", "nc4"), ("m.nc4", None)])
def test_netcdf_4_is_a_kind(tmp_path, name, kind):
    pytest.importorskip("netCDF4")
    rondel.mesh.from_points(sites()).to_mpas(tmp_path / name, kind=kind)
    assert (tmp_path / name).read_bytes()[:4] == b"\x89HDF"


def test_ugrid_is_what_its_checker_wants(tmp_path):
    checker = pytest.importorskip("ugrid_checks.check")
    pytest.importorskip("netCDF4")
    for kind in ("cdf5", "cdf2"):
        rondel.mesh.from_points(sites()).to_ugrid(tmp_path / "mesh.nc", kind=kind)
        checked = checker.check_dataset(str(tmp_path / "mesh.nc"), print_summary=False)
        assert "No problems found" in checked.checking_report()


def test_the_report_has_what_is_wrong(tmp_path):
    mesh = rondel.mesh.from_points(sites())
    quality = mesh.quality
    edge = quality["min_edge_ratio"]["where"]
    ratios = mesh.vertex_distances / mesh.cell_distances
    assert quality["min_edge_ratio"]["value"] == ratios[edge] == ratios.min()
    assert sum(quality["sides"].values()) == 300
    mesh.quality_picture(tmp_path / "q.svg", num_worst=5)
    assert (tmp_path / "q.svg").read_text().count("<circle") == 15


def test_a_dataset_has_the_numbers_of_mpas():
    xarray = pytest.importorskip("xarray")
    mesh = rondel.mesh.from_points(sites())
    data = mesh.to_xarray()
    assert isinstance(data, xarray.Dataset)
    assert data.sizes["nCells"] == 300
    counts = data["nEdgesOnCell"].to_numpy()
    for name in ("edgesOnCell", "cellsOnCell", "verticesOnCell"):
        assert ((data[name].to_numpy() > 0).sum(axis=1) == counts).all()
    assert (data["lonCell"] >= 0).all()
    assert (data["lonCell"] < 2 * np.pi).all()


def test_what_is_no_mesh_is_refused():
    cube = [[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    with pytest.raises(rondel.InvalidInput, match="lie on one circle"):
        rondel.mesh.from_points(cube)
    assert (rondel.mesh.from_points(cube, allow_zero_edges=True).vertex_distances == 0).sum() == 6
    with pytest.raises(rondel.InvalidInput, match="does not surround"):
        rondel.mesh.from_points(np.abs(sites()))
    with pytest.raises(rondel.InvalidInput, match="299 densities"):
        rondel.mesh.from_points(sites(), density=np.ones(299))
    with pytest.raises(ValueError, match="density has the shape"):
        rondel.mesh.from_points(sites(), density=np.ones((300, 2)))
