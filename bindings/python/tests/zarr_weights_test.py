# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Weights as groups of Zarr arrays: what other programs read, blocks of targets, damaged groups."""

import itertools
import shutil

import numpy as np
import pytest

import rondel

zarr = pytest.importorskip("zarr", "3")


def made(**options):
    return rondel.remap("grid:10", "healpix:2", **options)


def expect_same(a, b):
    for name in ("indptr", "indices", "data"):
        assert np.array_equal(getattr(a, name), getattr(b, name)), name
    assert a.shape == b.shape


def entries_of(path, shape):
    """The matrix that a program makes which knows nothing of chunks."""
    group = zarr.open_group(path, mode="r")
    matrix = np.zeros(shape)
    pairs = group["row"][:] - 1, group["col"][:] - 1
    for each, size in zip(pairs, shape, strict=True):
        assert each.min() >= 0
        assert each.max() < size
    np.add.at(matrix, pairs, group["S"][:])
    return matrix


@pytest.mark.parametrize("per_chunk", [1, 37, 500, 1 << 20])
def test_weights_come_back_to_the_bit(tmp_path, per_chunk):
    weights = made().weights
    path = tmp_path / "w.zarr"
    weights.to_zarr(path, entries_per_chunk=per_chunk)
    expect_same(rondel.Weights.from_zarr(path), weights)
    dense = np.zeros(weights.shape)
    rows = np.repeat(np.arange(weights.shape[0]), np.diff(weights.indptr))
    dense[rows, weights.indices] = weights.data
    assert np.array_equal(entries_of(path, weights.shape), dense)


def test_a_block_of_targets_needs_the_chunks_of_its_own_entries(tmp_path):
    weights = made().weights
    path = tmp_path / "w.zarr"
    weights.to_zarr(path, entries_per_chunk=60)
    begins = zarr.open_group(path, mode="r")["chunk_row"][:]
    assert len(begins) > 10
    assert begins[[0, -1]].tolist() == [0, weights.shape[0]]
    assert (weights.indptr[begins[1:]] - weights.indptr[begins[:-1]]).max() <= 60
    for begin, end in ((0, 1), (5, 90), (191, 192), (40, 40), (0, 192), (begins[3], begins[4])):
        part = rondel.Weights.from_zarr(path, rows=slice(begin, end))
        expect_same(part, weights._of_rows(np.arange(begin, end)))
    # The other chunks may be gone.
    for file in path.glob("S/c.*"):
        if file.name != "c.3":
            file.unlink()
    part = rondel.Weights.from_zarr(path, rows=slice(begins[3], begins[4]))
    expect_same(part, weights._of_rows(np.arange(begins[3], begins[4])))
    with pytest.raises(ValueError, match="step 2"):
        rondel.Weights.from_zarr(path, rows=slice(0, 9, 2))
    with pytest.raises(TypeError, match="must be a slice, not int"):
        rondel.Weights.from_zarr(path, rows=3)


def test_targets_without_entries_stay_so(tmp_path):
    path = tmp_path / "w.zarr"
    for indptr, number in (([0, 0, 0, 2, 2, 3, 3, 3], 3), ([0, 0, 0, 0, 0, 0, 0, 0], 0)):
        weights = rondel.Weights(indptr, [4, 0, 2][:number], [0.5, 0.0, -1e-300][:number], (7, 5))
        for per_chunk in (1, 2, 9):
            weights.to_zarr(path, entries_per_chunk=per_chunk)
            expect_same(rondel.Weights.from_zarr(path), weights)
            for k in range(7):
                part = rondel.Weights.from_zarr(path, rows=slice(k, k + 1))
                expect_same(part, weights._of_rows(np.array([k])))


def test_a_remapping_comes_back(tmp_path):
    path = tmp_path / "w.zarr"
    mask = np.arange(36 * 18) % 7 != 0
    for options in ({}, {"order": 2, "norm": "fracarea", "source_mask": mask}):
        remap = made(**options)
        remap.to_zarr(path, entries_per_chunk=1000)
        back = rondel.Remap.from_zarr(path)
        expect_same(back.weights, remap.weights)
        for name in ("source_areas", "source_fractions", "target_fractions"):
            assert np.array_equal(getattr(back, name), getattr(remap, name))
        np.testing.assert_allclose(back.target_areas, remap.target_areas, rtol=1e-12)
        assert np.array_equal(back.source.mask, remap.source.mask)
        remap.to_netcdf(tmp_path / "a.nc")
        back.to_netcdf(tmp_path / "b.nc")
        assert (tmp_path / "a.nc").read_bytes() == (tmp_path / "b.nc").read_bytes()
    group = zarr.open_group(path, mode="r")
    assert group["src_grid_dims"][:].tolist() == [36, 18]
    assert group.attrs["normalization"] == "fracarea"


def test_cells_that_are_no_named_grid_are_given(tmp_path):
    path = tmp_path / "w.zarr"
    cells = rondel.lonlat_grid(4, 2)
    remap = rondel.remap(cells, "healpix:0")
    remap.to_zarr(path)
    with pytest.raises(ValueError, match="names no grid of the source: give its cells"):
        rondel.Remap.from_zarr(path)
    expect_same(rondel.Remap.from_zarr(path, cells).weights, remap.weights)
    for other in (rondel.lonlat_grid(2, 4), rondel.lonlat_grid(4, 4)):
        with pytest.raises(ValueError, match="the source has other cells"):
            rondel.Remap.from_zarr(path, other)
    remap.weights.to_zarr(path)
    with pytest.raises(ValueError, match="those of no remapping between cells"):
        rondel.Remap.from_zarr(path, cells)


def test_places_are_those_of_the_weights(tmp_path):
    path = tmp_path / "w.zarr"
    sites = np.random.default_rng(1).normal(size=(40, 3))
    targets = np.eye(3)
    weights = rondel.delaunay(sites).weights(targets, "sibson")
    weights.to_zarr(path, sites=sites, targets=targets, method="sibson")
    back = rondel.Weights.from_zarr(path)
    assert back.is_of(sites, targets)
    assert (back.sites_hash, back.targets_hash) == (weights.sites_hash, weights.targets_hash)
    np.testing.assert_allclose(back._places[1], [[0, 0], [90, 0], [0, 90]], atol=1e-12)
    assert zarr.open_group(path, mode="r").attrs["map_method"] == "sibson"
    with pytest.raises(ValueError, match="sites must be 40 points"):
        weights.to_zarr(path, sites=sites[1:])
    with pytest.raises(ValueError, match="the targets are not those of the weights"):
        weights.to_zarr(path, targets=targets[::-1])
    with pytest.raises(ValueError, match="entries_per_chunk must be 1 or more, not 0"):
        weights.to_zarr(path, entries_per_chunk=0)


def test_a_regridder_takes_weights_of_a_group(tmp_path):
    xarray = pytest.importorskip("xarray")
    path = tmp_path / "w.zarr"
    lon, lat = np.arange(5.0, 360, 10), np.arange(-85.0, 90, 10)
    made().to_zarr(path)
    weights = rondel.Weights.from_zarr(path)
    grid = xarray.Dataset(coords={"lon": lon - 180, "lat": lat})
    field = np.random.default_rng(2).normal(size=(18, 36))
    found = rondel.Regridder(grid, "healpix:2", "conservative", weights=weights)(field)
    assert np.array_equal(found, rondel.Regridder(grid, "healpix:2", "conservative")(field))
    with pytest.raises(ValueError, match="target"):
        rondel.Regridder(grid, "healpix:2:ring", "conservative", weights=weights)


def test_tasks_of_dask_take_blocks_of_targets(tmp_path):
    dask = pytest.importorskip("dask")
    path = tmp_path / "w.zarr"
    remap = made()
    remap.to_zarr(path, entries_per_chunk=300)
    field = np.random.default_rng(2).normal(size=remap.weights.shape[1])
    begins = zarr.open_group(path, mode="r")["chunk_row"][:].tolist()
    read = dask.delayed(rondel.Weights.from_zarr)
    rows = [slice(*pair) for pair in itertools.pairwise(begins)]
    parts = dask.compute(*[read(path, rows=some).apply(field) for some in rows])
    assert np.array_equal(np.concatenate(parts), remap.weights.apply(field))


def test_other_folders_and_damaged_groups_are_refused(tmp_path):
    path = tmp_path / "w.zarr"
    with pytest.raises(FileNotFoundError):
        rondel.Weights.from_zarr(path)
    path.mkdir()
    with pytest.raises(OSError, match="no group of Zarr arrays"):
        rondel.Weights.from_zarr(path)
    path.rmdir()
    rondel.delaunay([*np.eye(3).tolist(), [-1, -1, -1]]).to_zarr(path)
    with pytest.raises(ValueError, match=r"no weights that to_zarr.. wrote: it has no S, row, col"):
        rondel.Weights.from_zarr(path)
    made().to_zarr(path, entries_per_chunk=100)  # a group of ours is replaced
    assert len(rondel.Weights.from_zarr(path).data) > 100
    for name, values in (
        ("row_begin", np.arange(193)[::-1]),
        ("row_begin", np.arange(193) * 1000),
        ("chunk_row", lambda rows: rows[::-1]),
        ("chunk_row", lambda rows: np.minimum(rows, rows[-2])),
        ("col", lambda numbers: numbers + 1000),
        ("S", lambda numbers: numbers * np.nan),
    ):
        made().to_zarr(path, entries_per_chunk=100)
        array = zarr.open_group(path, mode="r+")[name]
        array[:] = values(array[:]) if callable(values) else values
        with pytest.raises(ValueError, match=r"w.zarr: "):
            rondel.Weights.from_zarr(path)
    (path / "mine").write_text("")
    with pytest.raises(FileExistsError, match="'mine' in it is not ours"):
        made().to_zarr(path)
    shutil.rmtree(path)
    with pytest.raises(FileNotFoundError):
        made().to_zarr(tmp_path / "nowhere" / "w.zarr")


def test_lost_and_damaged_chunks_are_refused(tmp_path):
    path = tmp_path / "w.zarr"
    remap = made()
    remap.to_zarr(path, entries_per_chunk=300)
    # Programs read rows in place of row_begin, and the command has no use for lengths of grids.
    unread = ("row", "src_grid_dims", "dst_grid_dims")
    chunks = [chunk for chunk in sorted(path.glob("*/c.*")) if chunk.parent.name not in unread]
    assert len({chunk.parent.name for chunk in chunks}) == 14
    for chunk in chunks:
        name = chunk.parent.name
        whole = chunk.read_bytes()
        chunk.unlink()
        with pytest.raises(OSError, match=rf"w.zarr: the chunk {chunk.name} of {name} is lost"):
            rondel.Remap.from_zarr(path)
        for bad in (whole[:-3], whole[:-1] + bytes([whole[-1] ^ 1]), b""):
            chunk.write_bytes(bad)
            with pytest.raises(OSError, match=f"w.zarr: a chunk of {name} is damaged"):
                rondel.Remap.from_zarr(path)
        chunk.write_bytes(whole)
    expect_same(rondel.Remap.from_zarr(path).weights, remap.weights)
    shutil.rmtree(path / "S")
    with pytest.raises(OSError, match=r"the chunk c.0 of S is lost"):
        rondel.Weights.from_zarr(path, rows=slice(3, 5))


def test_areas_of_pixels_are_those_of_their_definition(tmp_path):
    pixels = rondel.remap("grid:30", "healpix:5")
    pixels.to_zarr(tmp_path / "w.zarr")
    areas = zarr.open_group(tmp_path / "w.zarr", mode="r")["area_b"][:]
    assert (areas == 4 * np.pi / (12 * 4**5)).all()
    assert np.array_equal(rondel.Remap.from_zarr(tmp_path / "w.zarr").target_areas, areas)
    grid = zarr.open_group(tmp_path / "w.zarr", mode="r")["area_a"][:]
    assert np.array_equal(grid, pixels.source_areas)


@pytest.mark.parametrize(
    ("method", "options"),
    [
        ("conservative", {}),
        ("conservative", {"extrap_method": "nearest_s2d"}),
        ("bilinear", {}),
        ("nearest_s2d", {"extrap_method": None}),
    ],
)
def test_a_regridder_writes_its_weights(tmp_path, method, options):
    xarray = pytest.importorskip("xarray")
    path = tmp_path / "w.zarr"
    lat, lon = np.arange(-85.0, 90, 10), np.arange(5.0, 360, 10)
    mask = np.ones((18, 36), np.int32)
    mask[3:9, 4:20] = 0
    grid = xarray.Dataset({"mask": (("lat", "lon"), mask)}, {"lat": lat, "lon": lon})
    regridder = rondel.Regridder(grid, "healpix:2", method, **options)
    regridder.to_zarr(path, entries_per_chunk=100)
    weights = rondel.Weights.from_zarr(path)
    expect_same(weights, regridder.weights)
    group = zarr.open_group(path, mode="r")
    assert group["src_grid_dims"][:].tolist() == [36, 18]
    assert np.array_equal(group["mask_a"][:], mask.reshape(-1))
    field = np.random.default_rng(3).normal(size=(18, 36))
    again = rondel.Regridder(grid, "healpix:2", method, weights=weights, **options)
    assert np.array_equal(again(field), regridder(field), equal_nan=True)
    with pytest.raises(ValueError, match="other places"):
        rondel.Regridder(grid.assign_coords(lon=lon + 1), "healpix:2", method, weights=weights)
