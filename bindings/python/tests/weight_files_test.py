# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Files of weights, as SciPy and other programs read them."""

import os
import subprocess
import sys

import clouds
import numpy as np
import pytest
import scipy.io
import scipy.sparse

import rondel

SITES = clouds.uniform(80)
TARGETS = clouds.uniform(30, seed=1).reshape(5, 6, 3)
WEIGHTS = rondel.delaunay(SITES).weights(TARGETS)
VALUES = np.random.default_rng(0).normal(size=80)


@pytest.mark.parametrize("format", ["esmf", "scrip"])
def test_what_is_written_is_read(tmp_path, format):
    path = tmp_path / "weights.nc"
    for options in ({}, {"sites": SITES, "targets": TARGETS, "method": "sibson"}):
        WEIGHTS.to_netcdf(path, format, **options)
        found = rondel.read_weights(path)
        assert found.shape == WEIGHTS.shape
        assert np.array_equal(found.apply(VALUES), WEIGHTS.apply(VALUES))
        assert found.is_of(SITES, TARGETS)
    assert os.listdir(tmp_path) == ["weights.nc"]


def test_names_of_esmf(tmp_path):
    WEIGHTS.to_netcdf(tmp_path / "w.nc", sites=SITES, targets=TARGETS)
    with scipy.io.netcdf_file(tmp_path / "w.nc", mmap=False) as file:
        names = ("S", "row", "col", "xc_a", "yc_a", "xc_b", "dst_grid_dims")
        data, row, col, lon, lat, to_lon, dims = (file.variables[name][:] for name in names)
        assert [file.variables[name].start_index for name in ("row", "col")] == [1, 1]
    matrix = scipy.sparse.coo_matrix((data, (row - 1, col - 1)), shape=(30, 80))
    assert np.allclose(matrix @ VALUES, WEIGHTS.apply(VALUES), atol=1e-15)
    assert np.allclose(rondel.unit_vectors(lon, lat), SITES, atol=1e-14)
    assert np.allclose(to_lon, rondel.lonlat(TARGETS)[..., 0].ravel())
    assert dims.tolist() == [6, 5]  # as Fortran counts


def test_areas(tmp_path):
    areas = rondel.SphericalVoronoi(SITES).calculate_areas()
    WEIGHTS.to_netcdf(
        tmp_path / "w.nc", sites=SITES, site_areas=areas, target_areas=np.ones((5, 6))
    )
    with scipy.io.netcdf_file(tmp_path / "w.nc", mmap=False) as file:
        assert np.array_equal(file.variables["area_a"][:], areas)
        assert np.array_equal(file.variables["area_b"][:], np.ones(30))
    with pytest.raises(ValueError, match="areas are 5 instead of 80"):
        WEIGHTS.to_netcdf(tmp_path / "w.nc", site_areas=areas[:5])
    WEIGHTS.to_netcdf(tmp_path / "w.nc", targets=TARGETS, target_areas=np.ones((5, 6)))
    with pytest.raises(ValueError, match=r"target_areas have the shape \(6, 5\), not \(5, 6\)"):
        WEIGHTS.to_netcdf(tmp_path / "w.nc", targets=TARGETS, target_areas=np.ones((6, 5)))


def test_names_of_scrip(tmp_path):
    WEIGHTS.to_netcdf(tmp_path / "w.nc", "scrip", sites=SITES, targets=TARGETS)
    with scipy.io.netcdf_file(tmp_path / "w.nc", mmap=False) as file:
        names = ("remap_matrix", "dst_address", "src_address")
        data, row, col = (file.variables[name][:] for name in names)
    matrix = scipy.sparse.coo_matrix((data[:, 0], (row - 1, col - 1)), shape=(30, 80))
    assert np.allclose(matrix @ VALUES, WEIGHTS.apply(VALUES), atol=1e-15)


def test_matrices_of_scipy(tmp_path):
    for name in ("theirs.npz", "ours.npz"):
        if name == "ours.npz":
            WEIGHTS.save(tmp_path / name)
        else:
            scipy.sparse.save_npz(tmp_path / name, WEIGHTS.tocsr())
        found = rondel.read_weights(tmp_path / name)
        assert np.array_equal(found.apply(VALUES), WEIGHTS.apply(VALUES))


def test_errors(tmp_path):
    path = tmp_path / "w.nc"
    for options, message in (
        ({"format": "netcdf"}, "format must be 'esmf' or 'scrip'"),
        ({"sites": SITES[::-1]}, "the sites are not those of the weights"),
        ({"targets": TARGETS + 1}, "the targets are not those of the weights"),
        ({"sites": SITES[:5]}, "sites must be 80 points"),
        ({"targets": np.zeros((30, 2))}, "targets must be 30 points"),
    ):
        with pytest.raises(ValueError, match=message):
            WEIGHTS.to_netcdf(path, **options)
    assert not path.exists()
    with pytest.raises(FileNotFoundError):
        rondel.read_weights(path)
    with pytest.raises(FileNotFoundError):
        WEIGHTS.to_netcdf(tmp_path / "none" / "w.nc")
    path.write_bytes(b"CDF?")
    with pytest.raises(OSError, match=r"w\.nc"):
        rondel.read_weights(path)


def test_netcdf4_by_the_library_of_the_wheel(tmp_path):
    """It is found without importing netCDF4, which in its turn reads what was written."""
    netcdf4 = pytest.importorskip("netCDF4")
    WEIGHTS.to_netcdf(tmp_path / "w.nc4", sites=SITES, targets=TARGETS)
    with netcdf4.Dataset(tmp_path / "w.nc4") as file:
        assert file.data_model == "NETCDF4"
        assert np.array_equal(np.sort(file["S"][:]), np.sort(WEIGHTS.data))
    found = rondel.read_weights(tmp_path / "w.nc4")
    assert np.array_equal(found.apply(VALUES), WEIGHTS.apply(VALUES))
    with netcdf4.Dataset(tmp_path / "grid.nc", "w") as file:
        for name, unit, values in (
            ("lat", "degrees_north", [-45, 45]),
            ("lon", "degrees_east", [0, 120, 240]),
        ):
            file.createDimension(name, len(values))
            axis = file.createVariable(name, "f4", (name,), zlib=True)
            axis.setncattr_string("units", unit)
            axis[:] = values
        file.createVariable("station", str, ("lat",))
    code = (
        "import sys, rondel; from rondel._netcdf import netcdf_library; "
        "assert netcdf_library() is not None and 'netCDF4' not in sys.modules; "
        "print(rondel.CellSet.read(sys.argv[1]).areas.sum())"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, str(tmp_path / "grid.nc")],
        capture_output=True,
        text=True,
        check=True,
    )
    assert float(done.stdout) == pytest.approx(4 * np.pi, rel=1e-14)
