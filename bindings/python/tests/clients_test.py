# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The modules of examples/clients, where the packages are installed that they are for."""

import importlib
import pathlib
import sys

import numpy as np
import pytest
from clouds import uniform

import rondel

FOLDER = pathlib.Path(__file__).parents[3] / "examples/clients"


def client(name, *packages):
    for package in packages:
        pytest.importorskip(package)
    if str(FOLDER) not in sys.path:
        sys.path.insert(0, str(FOLDER))
    return importlib.import_module(name)


@pytest.fixture
def anemoi():
    return client("anemoi_graphs", "torch", "torch_geometric", "anemoi.graphs.nodes.attributes")


@pytest.fixture
def remap():
    return client("uxarray_remap", "uxarray")


def graph_of(latlons, **attributes):
    import torch
    from torch_geometric.data import HeteroData

    graph = HeteroData()
    graph["nodes"].x = torch.as_tensor(latlons)
    for name, values in attributes.items():
        graph["nodes"][name] = torch.as_tensor(values)
    return graph


def test_nodes_of_the_globe_have_the_weights_of_anemoi(anemoi):
    from anemoi.graphs.nodes.attributes import SphericalAreaWeights

    graph = graph_of(np.radians(rondel.lonlat(uniform(1000, 2))[:, ::-1]).copy())
    for options in ({}, {"norm": "l1"}):
        ours = anemoi.AreaWeights(**options).compute(graph, "nodes").numpy()
        theirs = SphericalAreaWeights(**options).compute(graph, "nodes").numpy()
        np.testing.assert_allclose(ours, theirs, rtol=1e-4)
    unit, earth = (anemoi.AreaWeights(radius=r).compute(graph, "nodes") for r in (1, 6371))
    np.testing.assert_allclose(earth, 6371**2 * unit, rtol=1e-6)


def test_poles_of_single_precision_and_nodes_in_one_place(anemoi):
    lat, lon = np.meshgrid(np.linspace(-90, 90, 19), np.arange(0, 360, 10), indexing="ij")
    latlons = np.radians(np.stack([lat.ravel(), lon.ravel()], axis=1)).astype(np.float32)
    weights = anemoi.AreaWeights(dtype="float64").compute(graph_of(latlons), "nodes").numpy()[:, 0]
    assert weights.sum() == pytest.approx(4 * np.pi, rel=1e-12)
    np.testing.assert_allclose(weights[:36], weights[0], rtol=1e-12)
    assert weights[0] > 0


def test_regional_and_masked_nodes(anemoi):
    lat, lon = np.meshgrid(np.arange(0, 3, 0.1), np.arange(0, 4, 0.1), indexing="ij")
    latlons = np.radians(np.stack([lat.ravel(), lon.ravel()], axis=1))
    mask = (lon.ravel() < 1.95)[:, None]
    graph = graph_of(latlons, part=mask, half=0.5 * mask)
    weights = anemoi.RegionalAreaWeights().compute(graph, "nodes").numpy()
    np.testing.assert_allclose(weights, np.radians(0.1) ** 2, rtol=0.003)
    masked = anemoi.MaskedRegionalAreaWeights(mask_node_attr_name="part")
    inside = masked.compute(graph, "nodes").numpy()
    np.testing.assert_allclose(inside[mask], weights[mask], rtol=1e-3)
    assert np.all(inside[~mask] == 0)
    halved = anemoi.MaskedRegionalAreaWeights(mask_node_attr_name="half")
    np.testing.assert_allclose(halved.compute(graph, "nodes"), 0.5 * inside, rtol=1e-6)


def test_the_program_prints_the_weights_of_a_domain(anemoi, capsys):
    anemoi.main()
    globe, region = (line.split() for line in capsys.readouterr().out.splitlines())
    assert globe == ["AreaWeights:", "corner", "1.0000,", "middle", "0.0000"]
    assert region == ["RegionalAreaWeights:", "corner", "1.0000,", "middle", "0.8923"]


def mesh_of(points):
    """A grid of UXarray whose faces are Voronoi cells, and the diagram."""
    import uxarray as ux

    diagram = rondel.SphericalVoronoi(points)
    return ux.Grid.from_dataset(diagram.to_xarray()), diagram


@pytest.fixture
def meshes(remap):
    """A source with fields at faces and nodes, a target, and the diagrams of both."""
    import uxarray as ux

    (grid, diagram), (target, targets) = mesh_of(uniform(400, 1)), mesh_of(uniform(300, 2))
    at_faces = np.stack([diagram.points[:, 2], np.ones(400)])
    fields = {"z": (("time", "n_face"), at_faces), "node": ("n_node", grid.node_z.values)}
    source = ux.UxDataset(fields, coords={"time": [5, 7]}, uxgrid=grid)
    return source, target, diagram, targets


def test_conservative_remapping_is_that_of_the_cells(remap, meshes):
    source, target, diagram, targets = meshes
    for options in ({}, {"order": 2}):
        out = source["z"].remap(
            target, backend="rondel", rondel_method="conservative", rondel_options=options
        )
        assert out.dims == ("time", "n_face")
        assert out.time.values.tolist() == [5, 7]
        expected = rondel.remap(diagram, targets, **options).weights.apply(source["z"].values)
        np.testing.assert_allclose(out.values, expected, rtol=1e-9, atol=1e-9)
        before = source["z"].values @ diagram.areas
        np.testing.assert_allclose(out.values @ targets.areas, before, atol=1e-9)


@pytest.mark.parametrize("remap_to", ["nodes", "edges", "faces"])
def test_nearest_and_inverse_distance_are_those_of_uxarray(remap, meshes, remap_to):
    source, target, *_ = meshes
    for method in ("nearest_neighbor", "inverse_distance_weighted"):
        ours, theirs = (
            getattr(source.remap, method)(target, remap_to=remap_to, backend=backend)
            for backend in ("rondel", "uxarray")
        )
        for name in ("z", "node"):
            ordered = theirs[name].transpose(*ours[name].dims)
            np.testing.assert_allclose(ours[name].values, ordered.values, rtol=1e-9)


def test_interpolation_between_faces_and_in_them(remap, meshes):
    source, target, _, targets = meshes
    z = targets.points[:, 2]
    out = source["z"].remap.bilinear(target, backend="rondel")
    np.testing.assert_allclose(out.values[0], z, atol=0.05)
    np.testing.assert_allclose(out.values[1], 1, atol=1e-12)
    native = source["node"].remap(target, backend="rondel", rondel_method="native")
    centers = target.face_z.values
    np.testing.assert_allclose(native.values, centers, atol=0.05)
    cubic = source["z"].remap(target, backend="rondel", rondel_method="cubic")
    np.testing.assert_allclose(cubic.values[0], z, atol=0.01)
    with pytest.raises(ValueError, match="values at faces"):
        source.remap.bilinear(target, backend="rondel")


def test_targets_along_axes(remap, meshes):
    source, *_ = meshes
    lon, lat = np.arange(5.0, 360, 10), np.arange(-85.0, 90, 10)
    out = source["z"].remap.to_rectilinear(lon, lat, backend="rondel", rondel_method="conservative")
    assert out.dims == ("time", "lat", "lon")
    areas = rondel.lonlat_grid(36, 18).areas.reshape(18, 36)
    assert np.sum(out.values[0] * areas) == pytest.approx(
        float(source["z"].values[0] @ rondel.SphericalVoronoi(uniform(400, 1)).areas), abs=1e-9
    )
    nearest = source.remap.to_lonlat(lon, lat, backend="rondel")
    places = rondel.unit_vectors(*np.meshgrid(lon, lat))
    for name, dim in (("z", "face"), ("node", "node")):
        sites = np.stack([source.uxgrid[f"{dim}_{axis}"].values for axis in "xyz"])
        expected = source[name].values[..., np.argmax(places @ sites, axis=-1)]
        np.testing.assert_array_equal(nearest[name].values, expected)


def test_a_part_of_the_sphere_leaves_the_rest_without_values(remap, meshes):
    source, target, *_ = meshes
    part = source["z"].isel(n_face=np.flatnonzero(source.uxgrid.face_lat.values > 0))
    out = part.remap(target, backend="rondel", rondel_method="conservative")
    is_south = target.face_lat.values < -40
    assert np.all(np.isnan(out.values[0]) | ~is_south | (out.values[0] == 0))
    native = part.remap.bilinear(target, backend="rondel")
    assert np.all(np.isnan(native.values[:, is_south]))
    near = part.remap.bilinear(target, backend="rondel", rondel_options={"outside": "nearest"})
    assert np.all(np.isfinite(near.values))
    is_known = np.isfinite(native.values)
    np.testing.assert_allclose(near.values[is_known], native.values[is_known], rtol=1e-14)


def test_arrays_of_dask_stay_lazy(remap, meshes):
    pytest.importorskip("dask")
    source, target, *_ = meshes
    eager = source["z"].remap(target, backend="rondel", rondel_method="conservative")
    lazy = source.chunk({"time": 1})["z"]
    out = lazy.remap(target, backend="rondel", rondel_method="conservative")
    assert out.chunks is not None
    np.testing.assert_array_equal(out.values, eager.values)


def test_what_the_backend_refuses(remap, meshes):
    source, target, *_ = meshes
    with pytest.raises(ValueError, match="rondel_method must be one of"):
        source.remap(target, backend="rondel", rondel_method="spline")
    with pytest.raises(ValueError, match="face-centered"):
        source["node"].remap(target, backend="rondel", rondel_method="conservative")
    with pytest.raises(ValueError, match="Invalid spatial dimension"):
        source["node"].remap(target, remap_to="corners", backend="rondel")
    with pytest.raises(TypeError, match="yac_method has no effect"):
        source["z"].remap(target, backend="rondel", yac_method="nnn")
    with pytest.raises(ValueError, match="Invalid backend"):
        source["z"].remap(target, backend="esmf")


@pytest.fixture
def regrid():
    module = client("xarray_regrid_rondel", "xarray_regrid", "dask")
    module.use_by_default()
    yield module
    module.use_by_default(False)


def field_on(lon, lat, **dims):
    """A smooth field on axes, for two times."""
    import xarray as xr

    x, y = np.meshgrid(np.radians(lon), np.radians(lat))
    values = np.stack([np.sin(y) + np.cos(y) * np.cos(x), np.ones(x.shape)])
    return xr.DataArray(
        values,
        {"time": [5, 7], "latitude": lat, "longitude": lon},
        name="t",
        attrs={"units": "K"},
    ).chunk(dims)


def test_conservative_means_are_those_of_the_cells(regrid):
    """The areas of cells are differences of longitudes times differences of sines of latitudes."""
    import xarray as xr

    data = field_on(np.arange(0.5, 360), np.arange(-89.5, 90))
    target = xr.Dataset(
        coords={"latitude": np.arange(85.0, -90, -10), "longitude": np.arange(-175.0, 180, 10)}
    )
    made = data.regrid.conservative(target)
    assert (made.dims, made.attrs) == (data.dims, data.attrs)
    np.testing.assert_array_equal(made.latitude, target.latitude)
    np.testing.assert_array_equal(made.longitude, target.longitude)
    sines = np.diff(np.sin(np.radians(np.arange(-90, 91))))
    turned = np.roll(data.values, 180, axis=2).reshape(2, 18, 10, 36, 10)
    expected = np.einsum("tibjk,ib->tij", turned, sines.reshape(18, 10)) / 10
    expected /= sines.reshape(18, 10).sum(axis=1)[:, None]
    np.testing.assert_allclose(made.values[:, ::-1], expected, rtol=1e-12, atol=1e-13)


@pytest.mark.parametrize("skipna", [True, False])
def test_missing_values_count_as_the_threshold_says(regrid, skipna):
    import xarray as xr

    data = field_on(np.arange(0.5, 360), np.arange(-89.5, 90))
    data[0, :, :3] = np.nan
    target = xr.Dataset(
        coords={"latitude": np.arange(-85.0, 90, 10), "longitude": np.arange(5.0, 360, 10)}
    )
    for threshold, is_kept in ((0.0, False), (0.25, False), (0.35, True), (1.0, True)):
        made = data.regrid.conservative(target, skipna=skipna, nan_threshold=threshold)
        assert np.isfinite(made.values[0, :, 0]).all() == (is_kept and skipna)
        assert np.isfinite(made.values[0, :, 1:]).all()
    with pytest.raises(ValueError, match="from 0 to 1"):
        data.regrid.conservative(target, nan_threshold=1.5)


def test_columns_that_go_more_than_once_around(regrid):
    """Each cell is by itself: the last one overlaps the first."""
    import xarray as xr

    data = field_on(np.arange(0.5, 360), np.arange(-89.5, 90))
    rows = {"latitude": np.arange(-80.0, 81, 20)}
    whole = data.regrid.conservative(
        xr.Dataset(coords={**rows, "longitude": np.arange(0.0, 360.1, 2.2)})
    )
    assert whole.shape == (2, 9, 164)
    last = data.regrid.conservative(
        xr.Dataset(coords={**rows, "longitude": np.arange(0.0, 360.1, 2.2)[-3:]})
    )
    np.testing.assert_allclose(whole.values[:, :, -3:], last.values, rtol=1e-12)
    np.testing.assert_allclose(whole.values[1], 1, rtol=1e-12)


def test_other_coordinates_are_left_to_the_package(regrid, monkeypatch):
    import xarray as xr

    def refuse(*_, **__):
        raise AssertionError("the data are in a plane")

    monkeypatch.setattr(regrid, "regridded", refuse)
    data = xr.DataArray(np.eye(8), {"x": np.arange(8.0), "y": np.arange(8.0)}, ("x", "y"))
    target = xr.Dataset(coords={"x": [1.5, 5.5], "y": [1.5, 5.5]})
    assert data.regrid.conservative(target).shape == (2, 2)
    assert float(data.regrid.linear(target)[0, 0]) == 0.5


def test_any_grid_is_a_target_and_arrays_of_dask_stay_lazy(regrid):
    data = field_on(np.arange(2.5, 360, 5), np.arange(-87.5, 90, 5), time=1)
    made = data.regrid.rondel("healpix:3")
    assert made.chunks is not None
    assert (made.sizes["time"], made.size) == (2, 2 * 12 * 8**2)
    # Pixels have equal areas, so that their mean is that of the sphere.
    sines = np.diff(np.sin(np.radians(np.arange(-90, 91, 5))))
    assert float(made[0].mean()) == pytest.approx(
        sines @ data.values[0].mean(axis=1) / 2, abs=1e-12
    )
    second = data.regrid.rondel("healpix:3", "conservative_2nd")
    assert float(abs(second[0] - made[0]).max()) < 0.05
