# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Arrays of Dask that are regridded: lazy, in blocks of any lengths, with the same bytes."""

import numpy as np
import pytest

import rondel

xarray = pytest.importorskip("xarray")
dask = pytest.importorskip("dask")
pytest.importorskip("dask.array")
import rondel.xarray  # noqa: E402 (the accessor, which needs xarray)

LON, LAT = np.arange(2.5, 360, 5), np.arange(-87.5, 90, 5)
METHODS = ("conservative", "conservative_2nd", "nearest", "linear", "sibson", "bilinear")
# The chunks of time, level and the source; and those of the target.
CHUNKS = (
    ({"time": 1}, None),
    ({"time": 2, "level": 1, "lat": 9, "lon": 50}, 7),
    ({"time": (3, 2), "lat": 1}, {"lat": (3, 4, 11), "lon": 5}),
    ({}, (18, 1)),
)


def dataset():
    generator = np.random.default_rng(6)
    warm = generator.normal(size=(5, 2, LAT.size, LON.size))
    warm[1, :, 10:20, 30:50] = np.nan
    kind = generator.integers(1, 4, (LAT.size, LON.size)).astype("i2")
    return xarray.Dataset(
        {
            "warm": (("time", "level", "lat", "lon"), warm, {"units": "K"}),
            "single": (("lat", "time", "lon"), warm[:, 0].swapaxes(0, 1).astype("f4")),
            "kind": (("lat", "lon"), kind, {"flag_meanings": "a b c"}),
        },
        {"time": np.arange(5.0), "lat": LAT, "lon": LON},
    )


def assert_same_bytes(found, wanted):
    assert found.dims == wanted.dims
    assert found.dtype == wanted.dtype
    assert found.values.tobytes() == wanted.values.tobytes()


@pytest.mark.parametrize("method", METHODS)
def test_values_do_not_depend_on_chunks(method):
    data = dataset()
    wanted = rondel.regrid(data, "grid:20x18", method)
    assert wanted.warm.shape == (5, 2, 18, 20)
    for chunks, output_chunks in CHUNKS:
        lazy = data.chunk(chunks)
        found = lazy.rondel.regrid("grid:20x18", method, output_chunks=output_chunks)
        for name in data.data_vars:
            assert isinstance(found[name].data, dask.array.Array)
            assert_same_bytes(found[name], wanted[name])


def test_blocks_are_those_that_are_wanted():
    lazy = dataset().warm.chunk({"time": 2, "lat": 10})
    regridder = rondel.Regridder(lazy, "grid:20x18", "conservative_normed")
    found = regridder(lazy, output_chunks={"lat": (3, 4, 11)})
    assert found.chunks == ((2, 2, 1), (2,), (3, 4, 11), (20,))
    assert regridder(lazy).chunks == ((2, 2, 1), (2,), (18,), (20,))
    with dask.config.set({"array.chunk-size": "4 KiB"}):
        few = regridder(lazy)
        assert few.data.npartitions > 10
    assert_same_bytes(few, found)
    pixels = rondel.Regridder(lazy, "healpix:2", "conservative_normed")
    assert pixels(lazy, output_chunks=100).chunks == ((2, 2, 1), (2,), (100, 92))
    plain = pixels(lazy.data, output_chunks=(100,))
    assert isinstance(plain, dask.array.Array)
    assert plain.chunks[-1] == (100, 92)
    np.testing.assert_array_equal(plain, pixels(lazy.values))


def test_a_block_needs_its_own_part_of_the_work():
    computed = []

    def noted(block, block_info=None):
        computed.append(block_info[0]["chunk-location"])
        return block

    data = dataset().warm.chunk({"time": 1})
    data = data.copy(data=data.data.map_blocks(noted, dtype=data.dtype, meta=data.data._meta))
    found = rondel.regrid(data, "grid:20x18", output_chunks=6)
    assert computed == []
    block = found.isel(time=3, lat=slice(0, 6), lon=slice(6, 12)).values
    assert computed == [(3, 0, 0, 0)]
    np.testing.assert_array_equal(
        block, rondel.regrid(dataset().warm, "grid:20x18")[3, :, :6, 6:12]
    )


def test_graphs_can_be_sent_to_other_processes():
    cloudpickle = pytest.importorskip("cloudpickle")  # as Dask does
    data = dataset().warm.chunk({"time": 2})
    found = rondel.regrid(data, "healpix:2", output_chunks=50)
    again = cloudpickle.loads(cloudpickle.dumps(found))
    np.testing.assert_array_equal(again, rondel.regrid(dataset().warm, "healpix:2"))


def test_unmapped_targets_and_missing_values_are_those_of_arrays():
    data = dataset().isel(lat=slice(0, 20), lon=slice(0, 30))
    target = {"lon": np.arange(3.0, 360, 12), "lat": np.arange(-84.0, 90, 12)}
    for is_nan in (True, False):
        regridder = rondel.Regridder(data, target, "bilinear", unmapped_to_nan=is_nan)
        wanted = regridder(data.warm, skipna=True, na_thres=0.3)
        found = regridder(data.warm.chunk({"time": 1}), skipna=True, na_thres=0.3, output_chunks=4)
        assert_same_bytes(found, wanted)


def test_chunks_that_do_not_fit_are_refused():
    lazy = dataset().warm.chunk()
    regridder = rondel.Regridder(lazy, "grid:20x18", "nearest_s2d")
    with pytest.raises(ValueError, match=r"output_chunks has z, which are no dimensions of the"):
        regridder(lazy, output_chunks={"z": 3})
    with pytest.raises(ValueError, match=r"output_chunks has 1 lengths for the 2 dimensions"):
        regridder(lazy, output_chunks=(3,))
    with pytest.raises(ValueError, match=r"[Cc]hunks"):
        regridder(lazy, output_chunks=((3, 3), 20))
    with pytest.warns(UserWarning, match="output_chunks has no effect on arrays that are not of"):
        regridder(dataset().warm, output_chunks=3)
