# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Values in the cells of meshes, against weights that fractions compute; extrapolation."""

from fractions import Fraction

import numpy as np
import pytest

import rondel


def exact(point):
    return [Fraction(float(x)) for x in point]


def determinant(a, b, c):
    """The sign and size of det(a, b, c), exactly."""
    return (
        a[0] * (b[1] * c[2] - b[2] * c[1])
        - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
    )


def wachspress(corners, target):
    """The weights of a convex cell, exactly but for the last division; None outside."""
    corners, target = [exact(corner) for corner in corners], exact(target)
    n = len(corners)
    sides = [determinant(corners[k], corners[(k + 1) % n], target) for k in range(n)]
    if min(sides) < 0:
        return None
    weights = []
    for k in range(n):
        product = determinant(corners[k - 1], corners[k], corners[(k + 1) % n])
        for j in range(n):
            if j not in (k, (k - 1) % n):
                product *= sides[j]
        weights.append(product)
    total = sum(weights)
    return [float(weight / total) for weight in weights]


def turn(a, b, c):
    """The sine of the angle by which a path turns at b, to the left."""
    return np.linalg.det([a, b, c]) / np.linalg.norm(b - a) / np.linalg.norm(c - b)


@pytest.fixture
def mesh():
    """The Voronoi cells of random sites: nodes, faces, and centers."""
    points = np.random.default_rng(5).normal(size=(150, 3))
    diagram = rondel.delaunay(points / np.linalg.norm(points, axis=1)[:, None]).voronoi()
    rings = rondel.CellSet.voronoi(diagram)._cells.rings()
    ends = rings.rings[1:]
    faces = np.full((len(ends), int(np.diff(rings.rings).max())), -1)
    for i, (begin, end) in enumerate(zip(rings.rings, ends, strict=False)):
        faces[i, : end - begin] = rings.corners[begin:end]
    lon, lat = rondel.lonlat(rings.points).T
    return lon, lat, faces


def targets(count, seed):
    generator = np.random.default_rng(seed)
    lat = np.degrees(np.arcsin(generator.uniform(-1, 1, count)))
    return generator.uniform(-180, 180, count), lat


def test_weights_are_those_of_fractions(mesh):
    lon, lat, faces = mesh
    nodes = rondel.unit_vectors(lon, lat)
    to_lon, to_lat = targets(200, 1)
    weights = rondel.native_weights(lon, lat, faces, to_lon, to_lat)
    to = rondel.unit_vectors(to_lon, to_lat)
    compared = 0
    for t in range(200):
        begin, end = weights.indptr[t : t + 2]
        found = dict(zip(weights.indices[begin:end], weights.data[begin:end], strict=True))
        assert found
        for face in faces:
            ring = face[face >= 0]
            wanted = wachspress(nodes[ring], to[t])
            if wanted is None:
                continue
            assert set(found) <= set(ring)
            # Cells with a corner that hardly turns have mean values.
            turns = [turn(*nodes[ring[[k - 1, k, (k + 1) % len(ring)]]]) for k in range(len(ring))]
            if min(turns) > 2**-9:
                given = [found.get(node, 0.0) for node in ring]
                np.testing.assert_allclose(given, wanted, rtol=0, atol=1e-11)
                compared += 1
    assert compared > 100


def test_linear_fields_and_nodes_are_reproduced(mesh):
    lon, lat, faces = mesh
    nodes = rondel.unit_vectors(lon, lat)
    field = nodes @ [0.3, -0.5, 0.7]
    at_nodes = rondel.native_weights(lon, lat, faces, lon, lat)
    np.testing.assert_array_equal(at_nodes @ field, field)
    to_lon, to_lat = targets(2000, 2)
    weights = rondel.native_weights(lon, lat, faces, to_lon, to_lat)
    to = rondel.unit_vectors(to_lon, to_lat)
    sums = np.stack([weights @ nodes[:, k].copy() for k in range(3)], axis=1)
    shortened = (sums * to).sum(axis=1)
    assert (shortened > 0).all()
    assert (shortened <= 1 + 1e-15).all()
    np.testing.assert_allclose(sums, shortened[:, None] * to, rtol=0, atol=1e-14)


def test_centers_are_interpolated_in_the_dual(mesh):
    lon, lat, faces = mesh
    nodes = rondel.unit_vectors(lon, lat)
    centers = np.stack([nodes[face[face >= 0]].sum(axis=0) for face in faces])
    at = tuple(rondel.lonlat(centers / np.linalg.norm(centers, axis=1)[:, None]).T)
    values = np.arange(float(len(faces)))
    weights = rondel.native_weights(lon, lat, faces, *at, centers=at)
    np.testing.assert_array_equal(weights @ values, values)
    weights = rondel.native_weights(lon, lat, faces, *targets(500, 3), centers=at)
    assert (np.diff(weights.indptr) == 3).all()


def test_faces_may_be_masked_and_turned():
    lon, lat = [0, 10, 10, 0, 5], [0, 0, 10, 10, 20]
    given = [[0, 1, 2, 3], [2, 3, 4, -1]]
    wanted = rondel.native_weights(lon, lat, given, [5, 5], [5, 15])
    masked = np.ma.masked_less(np.array([[3, 2, 1, 0], [4, 3, 2, -1]]), 0)
    found = rondel.native_weights(lon, lat, masked, [5, 5], [5, 15])
    np.testing.assert_array_equal(found.data, wanted.data)


@pytest.mark.parametrize(
    ("faces", "words"),
    [
        ([[0, 1, 7]], "face 0 has a corner that is none of 3 nodes"),
        ([[0, -1, 2]], "stand before nodes"),
        ([0, 1, 2], "integers of shape"),
        ([[0.5, 1, 2]], "integers of shape"),
    ],
)
def test_wrong_faces_are_refused(faces, words):
    with pytest.raises(ValueError, match=words):
        rondel.native_weights([0, 10, 0], [0, 0, 10], faces, [1], [1])


def test_wide_faces_are_refused():
    with pytest.raises(rondel.InvalidInput, match="as wide as a hemisphere"):
        rondel.native_weights([0, 120, 240], [0, 0, 0], [[0, 1, 2]], [1], [1])


@pytest.fixture
def region():
    pytest.importorskip("xarray")
    source = {"lon": np.arange(0.0, 21, 2), "lat": np.arange(0.0, 21, 2)}
    target = {"lon": np.arange(-3.0, 25, 1), "lat": np.arange(-3.0, 25, 1)}
    field = np.add.outer(source["lat"], 10 * source["lon"])
    return source, target, field


@pytest.mark.parametrize("method", ["inverse_dist", "idw"])
def test_regridder_extrapolates_by_inverse_distance(region, method):
    source, target, field = region
    plain = rondel.Regridder(source, target, "bilinear")(field)
    found = rondel.Regridder(
        source, target, "bilinear", extrap_method=method, extrap_num_src_pnts=3
    )(field)
    assert np.isnan(plain).any()
    np.testing.assert_array_equal(found[~np.isnan(plain)], plain[~np.isnan(plain)])
    lat, lon = np.meshgrid(source["lat"], source["lon"], indexing="ij")
    points = rondel.unit_vectors(lon.ravel(), lat.ravel())
    for j, i in np.argwhere(np.isnan(plain)):
        at = rondel.unit_vectors(target["lon"][i], target["lat"][j])
        squares = ((points - at) ** 2).sum(axis=1)
        near = np.argsort(squares, kind="stable")
        if squares[near[3]] - squares[near[2]] < 1e-12:
            continue  # of equal distances either may count
        wanted = (field.ravel()[near[:3]] / squares[near[:3]]).sum() / (1 / squares[near[:3]]).sum()
        assert abs(found[j, i] - wanted) < 1e-10


def test_limits_of_extrapolation_are_those_of_xesmf(region):
    source, target, field = region
    wanted = rondel.Regridder(source, target, "bilinear", extrap_method="inverse_dist")(field)
    of_xesmf = {"extrap_dist_exponent": 2.0, "extrap_num_src_pnts": None}
    found = rondel.Regridder(source, target, "bilinear", extrap_method="inverse_dist", **of_xesmf)
    np.testing.assert_array_equal(found(field), wanted)
    rondel.Regridder(source, target, "bilinear", **of_xesmf, extrap_num_levels=None)
    for options, error, message in (
        ({"extrap_dist_exponent": 1.5}, TypeError, "extrap_dist_exponent must be an integer"),
        ({"extrap_dist_exponent": 0}, ValueError, "extrap_dist_exponent must be from 1 to 100"),
        ({"extrap_num_src_pnts": 0}, ValueError, "extrap_num_src_pnts must be from 1 to"),
        ({"extrap_num_src_pnts": "8"}, TypeError, "extrap_num_src_pnts must be an integer"),
        ({"extrap_num_levels": -1}, ValueError, "extrap_num_levels must be from 0 to"),
        ({"extrap_distance": -5.0}, ValueError, "extrap_distance must not be negative"),
        ({"extrap_distance": "far"}, TypeError, "extrap_distance must be a number"),
    ):
        with pytest.raises(error, match=message):  # before there are grids
            rondel.Regridder(None, None, "bilinear", extrap_method="inverse_dist", **options)


def test_regridder_creeps_as_far_as_it_may(region):
    source, target, field = region
    plain = rondel.Regridder(source, target, "bilinear")(field)
    found = rondel.Regridder(
        source, target, "bilinear", extrap_method="creep_fill", extrap_num_levels=2
    )(field)
    wanted = plain.copy()
    for _ in range(2):
        padded = np.pad(wanted, 1, constant_values=np.nan)
        near = np.stack([padded[:-2, 1:-1], padded[2:, 1:-1], padded[1:-1, :-2], padded[1:-1, 2:]])
        number = np.isfinite(near).sum(axis=0)
        means = np.nansum(near, axis=0) / np.maximum(number, 1)
        wanted = np.where(np.isnan(wanted) & (number > 0), means, wanted)
    np.testing.assert_allclose(found, wanted, rtol=1e-13)
    assert np.isnan(found).any()


def test_regridder_has_a_largest_distance(region):
    source, target, field = region
    found = rondel.Regridder(
        source, target, "bilinear", extrap_method="nearest_s2d", extrap_distance=250.0
    )(field)
    assert np.isnan(found[0, 0])  # 3 degrees to the west and to the south
    assert not np.isnan(found[1, 5])
    with pytest.raises(ValueError, match="extrap_method must be"):
        rondel.Regridder(source, target, "bilinear", extrap_method="patch")


def test_corners_are_made_on_request(tmp_path):
    xarray = pytest.importorskip("xarray")
    j, i = np.mgrid[0:8, 0:9].astype(float)
    source = {"lon": 10 + i - 0.2 * j, "lat": 40 + 0.3 * i + j}
    with pytest.raises(ValueError, match="corners='made' makes them"):
        rondel.Regridder(source, "grid:1", "conservative_normed")
    with pytest.warns(UserWarning, match="made half way between the centers"):
        regridder = rondel.Regridder(source, "grid:1", "conservative_normed", corners="made")
    found = regridder(np.ones((8, 9)))
    assert np.isfinite(found).sum() > 50
    np.testing.assert_allclose(found[np.isfinite(found)], 1, rtol=1e-13)
    regridder.to_netcdf(tmp_path / "w.nc")
    with xarray.open_dataset(tmp_path / "w.nc") as file:
        assert "made half way" in file.attrs["source_corners"]
        assert "target_corners" not in file.attrs
    with pytest.raises(ValueError, match="corners must be"):
        rondel.Regridder(source, "grid:1", "conservative_normed", corners="guess")


def write_mesh(path, mesh, values):
    """A file of UGRID with values at the nodes."""
    netcdf = pytest.importorskip("netCDF4")
    lon, lat, faces = mesh
    with netcdf.Dataset(path, "w") as file:
        for name, size in (("node", len(lon)), ("face", len(faces)), ("corner", faces.shape[1])):
            file.createDimension(name, size)
        topology = file.createVariable("mesh", "i4")
        topology.setncatts(
            {
                "cf_role": "mesh_topology",
                "topology_dimension": 2,
                "node_coordinates": "x y",
                "face_node_connectivity": "faces",
            }
        )
        for name, numbers, units in (("x", lon, "degrees_east"), ("y", lat, "degrees_north")):
            variable = file.createVariable(name, "f8", ("node",))
            variable.units = units
            variable[:] = numbers
        connectivity = file.createVariable("faces", "i4", ("face", "corner"), fill_value=-1)
        connectivity.start_index = 0
        connectivity[:] = faces
        field = file.createVariable("t", "f8", ("node",))
        field.setncatts({"mesh": "mesh", "location": "node"})
        field[:] = values


def test_files_are_regridded_in_their_own_cells(mesh, tmp_path):
    xarray = pytest.importorskip("xarray")
    lon, lat, faces = mesh
    values = np.random.default_rng(8).normal(size=len(lon))
    write_mesh(tmp_path / "mesh.nc", mesh, values)
    out = tmp_path / "out.nc"
    report = rondel.regrid_file(f"{tmp_path / 'mesh.nc'}:t", "grid:10", out, method="native")
    assert (report.sources, report.missing) == (len(lon), 0)
    with xarray.open_dataset(out) as found:
        to_lon, to_lat = np.meshgrid(found.lon, found.lat)
        weights = rondel.native_weights(lon, lat, faces, to_lon.ravel(), to_lat.ravel())
        np.testing.assert_array_equal(found.t.values.ravel(), weights @ values)
    with pytest.raises(OSError, match="means over cells need values of cells"):
        rondel.regrid_file(f"{tmp_path / 'mesh.nc'}:t", "grid:10", out)


def test_a_regridder_interpolates_in_the_mesh_of_a_dataset(mesh, tmp_path):
    """It does what `regrid_file` does with the file, at nodes and at faces."""
    xarray = pytest.importorskip("xarray")
    lon = mesh[0]
    values = np.random.default_rng(8).normal(size=len(lon))
    write_mesh(tmp_path / "mesh.nc", mesh, values)
    rondel.regrid_file(
        f"{tmp_path / 'mesh.nc'}:t", "healpix:2", tmp_path / "out.nc", method="native"
    )
    with (
        xarray.open_dataset(tmp_path / "out.nc") as wanted,
        xarray.open_dataset(tmp_path / "mesh.nc") as source,
    ):
        regridder = rondel.Regridder(source, "healpix:2", "native")
        np.testing.assert_array_equal(regridder(source).t.values, wanted.t.values)
        found = rondel.regrid(source, "healpix:2", "native")
        np.testing.assert_array_equal(found.t.values, wanted.t.values)
        regridder.to_netcdf(tmp_path / "w.nc")
        again = rondel.Regridder(source, "healpix:2", "native", weights=tmp_path / "w.nc")
        np.testing.assert_array_equal(again(source).t.values, wanted.t.values)
        with pytest.raises(ValueError, match="not 'linear'"):
            rondel.Regridder(source, "healpix:2", "linear", weights=tmp_path / "w.nc")
        # A node without a place takes no part.
        x = source.x.copy()
        x[:3] = np.nan
        with pytest.warns(UserWarning, match="3 of .* places have no"):
            part = rondel.Regridder(source.assign(x=x), "healpix:2", "native")
        assert not set(part.weights.indices) & {0, 1, 2}
        with pytest.raises(ValueError, match="needs a Dataset with the mesh of the values"):
            rondel.Regridder(source.t.assign_coords(x=source.x, y=source.y), "healpix:2", "native")


@pytest.mark.parametrize("lon", ["lonCell", "lonVertex", "face_lon", "node_lon"])
def test_a_regridder_knows_the_meshes_that_files_have(lon, tmp_path):
    """Cells and vertices of MPAS, faces and nodes of UGRID, as `regrid_file` has them."""
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("netCDF4")
    mesh = rondel.mesh.scvt(n=200)
    path, lat = tmp_path / "mesh.nc", lon.replace("lon", "lat")
    (mesh.to_ugrid if "_" in lon else mesh.to_mpas)(path)
    with xarray.open_dataset(path) as source:
        source.load()
    (dim,) = source[lon].dims
    values = np.random.default_rng(1).normal(size=source.sizes[dim])
    field = tmp_path / "field.nc"
    data = source.assign(t=((dim,), values, {"coordinates": f"{lon} {lat}"}))
    data.to_netcdf(field, format="NETCDF3_64BIT", engine="netcdf4")
    out = tmp_path / "out.nc"
    rondel.regrid_file(f"{field}:t", "healpix:2", out, method="native", source=f"{field}:{lon}")
    found = rondel.Regridder(source, "healpix:2", "native", lon=lon, lat=lat)(values)
    with xarray.open_dataset(out) as wanted:
        np.testing.assert_array_equal(found, wanted.t.values)
    assert np.isfinite(found).all()


def test_a_regridder_interpolates_between_cells_of_a_set():
    pytest.importorskip("xarray")
    points = np.random.default_rng(6).normal(size=(200, 3))
    sites = points / np.linalg.norm(points, axis=1)[:, None]
    triangulation = rondel.delaunay(sites)
    to_lon, to_lat = targets(500, 4)
    values = np.random.default_rng(7).normal(size=200)
    wanted = triangulation.weights(rondel.unit_vectors(to_lon, to_lat), "linear") @ values
    cells = rondel.CellSet.voronoi(triangulation)
    target = {"lon": to_lon, "lat": to_lat}
    found = rondel.Regridder(cells, target, "native", locstream_out=True)(values)
    np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-12)
    named = rondel.Regridder("R2B1", target, "native", locstream_out=True)
    assert np.isfinite(named(np.ones(named.shape_in))).all()
    with pytest.raises(ValueError, match="'bilinear' is for a grid along"):
        rondel.Regridder("grid:30", target, "native", locstream_out=True)
    with pytest.raises(ValueError, match="needs a mesh"):
        rondel.Regridder({"lon": [0.0, 10], "lat": [0.0, 10]}, target, "native", locstream_out=True)


@pytest.mark.parametrize("method", ["foo", "nearest_s2d", "bilinear_"])
def test_methods_of_regrid_are_named(method):
    xarray = pytest.importorskip("xarray")
    data = xarray.DataArray(np.ones((2, 2)), {"lat": [0.0, 9], "lon": [0.0, 9]}, ("lat", "lon"))
    with pytest.raises(ValueError, match=f"'conservative', .*'native', not '{method}'"):
        rondel.regrid(data, "grid:30", method)


def test_fields_are_extrapolated_by_their_own_gaps(tmp_path):
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("netCDF4")
    lon, lat = np.arange(5.0, 360, 10), np.arange(-85.0, 90, 10)
    fields = np.random.default_rng(9).normal(size=(3, 18, 36))
    fields[np.random.default_rng(10).random(fields.shape) < 0.4] = np.nan
    xarray.DataArray(
        fields,
        {
            "lat": ("lat", lat, {"units": "degrees_north"}),
            "lon": ("lon", lon, {"units": "degrees_east"}),
        },
        ("time", "lat", "lon"),
        name="t",
    ).to_netcdf(tmp_path / "in.nc")
    report = rondel.regrid_file(
        tmp_path / "in.nc",
        "grid:36x18",
        tmp_path / "out.nc",
        method="nearest",
        extrapolate="nearest",
        extrapolate_distance=1500,
    )
    assert report.extrapolated > 100
    with xarray.open_dataset(tmp_path / "out.nc") as found:
        # The targets begin at longitude -175, in another order than the sources.
        to_lon, to_lat = np.meshgrid(found.lon, found.lat)
        got = found.t.values
    points = rondel.unit_vectors(*(grid.ravel() for grid in np.meshgrid(lon, lat)))
    to = rondel.unit_vectors(to_lon.ravel(), to_lat.ravel())
    angles = np.arccos(np.clip(to @ points.T, -1, 1))
    for time in range(3):
        known = np.isfinite(fields[time].ravel())
        away = np.where(known, angles, np.inf)
        nearest = away.min(axis=1)
        for t, value in enumerate(got[time].ravel()):
            if nearest[t] * 6371.229 > 1500:
                assert np.isnan(value)
                continue
            ties = fields[time].ravel()[away[t] < nearest[t] + 1e-9]
            assert value in ties


def test_files_tell_of_corners_that_were_made(tmp_path):
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("netCDF4")
    j, i = np.mgrid[0:10, 0:12].astype(float)
    places = {
        "lon": (("y", "x"), 10 + i - 0.2 * j, {"units": "degrees_east"}),
        "lat": (("y", "x"), 40 + 0.3 * i + j, {"units": "degrees_north"}),
    }
    xarray.Dataset({"t": (("y", "x"), np.ones((10, 12)))}, places).to_netcdf(tmp_path / "in.nc")
    with pytest.raises(OSError, match="have no bounds, so no cells"):
        rondel.regrid_file(tmp_path / "in.nc", "grid:1", tmp_path / "out.nc")
    report = rondel.regrid_file(tmp_path / "in.nc", "grid:1", tmp_path / "out.nc", corners="made")
    assert "made half way between the centers" in report.remarks[0]
    with xarray.open_dataset(tmp_path / "out.nc") as found:
        assert "made half way" in found.attrs["source_corners"]
        known = found.t.values[np.isfinite(found.t.values)]
    assert known.size > 80
    np.testing.assert_allclose(known, 1, rtol=1e-14)
    with pytest.warns(UserWarning, match="made half way"):
        cells = rondel.CellSet.read(tmp_path / "in.nc", corners="made")
    assert cells.shape == (10, 12)
    steps = np.radians(1) ** 2 * (1 + 0.3 * 0.2) * np.cos(np.radians(places["lat"][1]))
    np.testing.assert_allclose(cells.areas.reshape(10, 12), steps, rtol=1e-2)


def test_regrid_passes_on_what_regridders_take(region):
    xarray = pytest.importorskip("xarray")
    source, target, field = region
    data = xarray.DataArray(field, {"lat": source["lat"], "lon": source["lon"]}, ("lat", "lon"))
    plain = rondel.regrid(data, target, "bilinear")
    found = rondel.regrid(data, target, "bilinear", extrap_method="creep")
    assert np.isnan(plain).any()
    assert not np.isnan(found).any()


def test_weights_of_another_extrapolation_are_not_reused(region, tmp_path):
    source, target, _ = region
    made = rondel.Regridder(source, target, "bilinear", extrap_method="idw")
    made.to_netcdf(tmp_path / "w.nc")
    again = rondel.Regridder(
        source, target, "bilinear", extrap_method="inverse_dist", weights=tmp_path / "w.nc"
    )
    np.testing.assert_array_equal(again.weights.data, made.weights.data)
    with pytest.raises(ValueError, match="extrapolated by 'idw', not by 'creep'"):
        rondel.Regridder(
            source, target, "bilinear", extrap_method="creep", weights=tmp_path / "w.nc"
        )


def test_each_variable_has_its_own_grid(tmp_path):
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("netCDF4")
    j, i = np.mgrid[0:10, 0:12].astype(float)

    def places(name, shift):
        dims, columns = ("y", f"x_{name}"), slice(0, 12 if shift == 0 else 11)
        lon = 10 + i[:, columns] + shift - 0.2 * j[:, columns]
        lat = 40 + 0.3 * i[:, columns] + j[:, columns]
        return {
            f"lon_{name}": (dims, lon, {"units": "degrees_east"}),
            f"lat_{name}": (dims, lat, {"units": "degrees_north"}),
        }

    xarray.Dataset(
        {
            "t": (("y", "x_rho"), i, {"coordinates": "lon_rho lat_rho"}),
            "u": (("y", "x_u"), np.full((10, 11), 7.0), {"coordinates": "lon_u lat_u"}),
            **places("rho", 0),
            **places("u", 0.5),
        }
    ).to_netcdf(tmp_path / "roms.nc")
    out = tmp_path / "out.nc"
    report = rondel.regrid_file(f"{tmp_path / 'roms.nc'}:u", "grid:1", out, corners="made")
    assert report.sources == 110
    with xarray.open_dataset(out) as found:
        known = found.u.values[np.isfinite(found.u.values)]
    np.testing.assert_allclose(known, 7, rtol=1e-14)
    assert rondel.regrid_file(tmp_path / "roms.nc", "grid:1", out, corners="made").sources == 120


def test_duals_of_voronoi_cells_are_delaunay_triangles():
    points = np.random.default_rng(6).normal(size=(200, 3))
    sites = points / np.linalg.norm(points, axis=1)[:, None]
    triangulation = rondel.delaunay(sites)
    rings = rondel.CellSet.voronoi(triangulation)._cells.rings()
    faces = np.full((200, int(np.diff(rings.rings).max())), -1)
    for i, (begin, end) in enumerate(zip(rings.rings, rings.rings[1:], strict=False)):
        faces[i, : end - begin] = rings.corners[begin:end]
    to_lon, to_lat = targets(500, 4)
    found = rondel.native_weights(
        *rondel.lonlat(rings.points).T,
        faces,
        to_lon,
        to_lat,
        centers=tuple(rondel.lonlat(sites).T),
    )
    wanted = triangulation.weights(rondel.unit_vectors(to_lon, to_lat), "linear")
    values = np.random.default_rng(7).normal(size=200)
    np.testing.assert_allclose(found @ values, wanted @ values, rtol=0, atol=1e-12)


def test_contours_are_those_of_a_triangulation_where_the_faces_are():
    rng = np.random.default_rng(8)
    points = rng.normal(size=(300, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    lon, lat = rondel.lonlat(points).T
    tri = rondel.delaunay(rondel.unit_vectors(lon, lat))
    values = np.sin(3 * points[:, 0]) + points[:, 2]
    values[4] = np.nan
    faces = tri.simplices.copy()
    faces[::3] = faces[::3, ::-1]
    found = rondel.native_isolines(lon, lat, faces, values, [0.0, 0.5])
    wanted = tri.isolines(values, [0.0, 0.5])
    for name in ("points", "line_offsets", "level_offsets", "is_closed"):
        np.testing.assert_array_equal(getattr(found, name), getattr(wanted, name))
    bands = rondel.native_bands(lon, lat, faces, values, [0.0, 0.5])
    wanted = tri.bands(values, [0.0, 0.5])
    for name in ("points", "ring_offsets", "polygon_offsets", "band_offsets"):
        np.testing.assert_array_equal(getattr(bands, name), getattr(wanted, name))


def test_no_line_crosses_a_strait():
    """Two squares of 10 degrees, 2 degrees apart; the field jumps in between."""
    lon = [0, 10, 10, 0, 12, 22, 22, 12]
    lat = [0, 0, 10, 10] * 2
    faces = np.array([[0, 1, 2, 3], [4, 5, 6, 7]])
    values = np.array([0, 0, 1, 1, 10, 10, 11, 11.0])
    lines = rondel.native_isolines(lon, lat, faces, values, [0.5, 5, 10.5])
    assert np.diff(lines.level_offsets).tolist() == [1, 0, 1]
    reach = rondel.lonlat(lines.points)[:, 0]
    assert np.all((reach < 10.001) | (reach > 11.999))
    whole = rondel.delaunay(rondel.unit_vectors(lon, lat)).isolines(values, 5)
    assert len(whole.points) > 0
    # Values of faces are contoured between their centers: one line of three here.
    grid = np.arange(16).reshape(4, 4)
    faces = np.stack([grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]], -1).reshape(
        -1, 4
    )
    lon, lat = np.meshgrid(np.arange(4.0), np.arange(4.0))
    centers = np.meshgrid(np.arange(0.5, 3), np.arange(0.5, 3))
    found = rondel.native_isolines(
        lon.ravel(),
        lat.ravel(),
        faces,
        np.tile([0.0, 1, 2], 3),
        0.5,
        centers=[each.ravel() for each in centers],
    )
    assert len(found.is_closed) == 1
    np.testing.assert_allclose(rondel.lonlat(found.points)[[0, -1], 0], 1, atol=1e-3)


@pytest.mark.parametrize("contours", [rondel.native_isolines, rondel.native_bands])
def test_contours_of_cells_that_overlap_or_are_too_wide_are_refused(contours):
    around = np.radians(144.0 * np.arange(5))
    overlap = "cells 0 and 1 overlap at"
    for lon, lat, faces, message in (
        # One cell within another, two that cross, and a star that winds twice around its middle.
        (
            [0, 30, 30, 0, 10, 20, 20, 10],
            [0, 0, 30, 30, 10, 10, 20, 20],
            [[0, 1, 2, 3], [4, 5, 6, 7]],
            overlap,
        ),
        ([0, 10, 0, 5, 5, 15], [0, 5, 10, -5, 15, 5], [[0, 1, 2], [3, 4, 5]], overlap),
        (10 * np.cos(around), 10 * np.sin(around), [[0, 1, 2, 3, 4]], "cell 0 crosses or overlaps"),
        ([0, 120, 240], [0, 0, 0], [[0, 1, 2]], "cell 0 is as wide as a hemisphere"),
        ([0, 90, 180, 270], [0, 0, 0, 0], [[0, 1, 2, 3]], "cell 0 is as wide as a hemisphere"),
    ):
        with pytest.raises(rondel.InvalidInput, match=message):
            contours(lon, lat, faces, np.arange(len(lon)) * 1.0, [0.5, 1.5])


def test_contours_of_a_mesh_whose_nodes_hang_by_rounding_are_made():
    """A node in the middle of a long side is on it up to rounding alone: that is no overlap."""
    lon, lat = [0, 40, 40, 0, 20, 20], [0, 0, 30, 30, -30, 0]
    x = rondel.unit_vectors(lon, lat)
    x[5] = x[0] + x[1]
    lon, lat = rondel.lonlat(x / np.linalg.norm(x, axis=1)[:, None]).T
    found = rondel.native_bands(
        lon, lat, [[0, 1, 2, 3], [0, 4, 5, 5], [4, 1, 5, 5]], lat, [-90, 90]
    )
    assert found is not None


def test_a_face_that_crosses_itself_is_named(tmp_path):
    xarray = pytest.importorskip("xarray")
    lon, lat = np.array([0.0, 10, 20, 0, 10, 20]), np.array([0.0, 0, 0, 10, 10, 10])
    faces = np.array([[0, 1, 4, 3], [1, 5, 2, 4]])
    mesh = xarray.Dataset(
        {
            "mesh": (
                (),
                0,
                {
                    "cf_role": "mesh_topology",
                    "topology_dimension": 2,
                    "node_coordinates": "lon lat",
                    "face_node_connectivity": "corners",
                },
            ),
            "lon": ("node", lon, {"units": "degrees_east", "standard_name": "longitude"}),
            "lat": ("node", lat, {"units": "degrees_north", "standard_name": "latitude"}),
            "corners": (("face", "four"), faces, {"start_index": 0}),
            "t": ("node", lat, {"mesh": "mesh", "location": "node", "coordinates": "lon lat"}),
        }
    )
    mesh.to_netcdf(tmp_path / "in.nc")
    message = r"cell 1 crosses or overlaps itself at 15\.0\d* 5\.0"
    with pytest.raises(ValueError, match=message):
        rondel.regrid_file(tmp_path / "in.nc", "grid:5", tmp_path / "o.nc", method="native")
    with pytest.raises(ValueError, match=message):
        rondel.Regridder(mesh, "grid:5", "native", lon="lon", lat="lat")
    mesh["corners"][1] = [1, 2, 5, 4]
    mesh.to_netcdf(tmp_path / "right.nc")
    rondel.regrid_file(tmp_path / "right.nc", "grid:5", tmp_path / "o.nc", method="native")


def test_contours_of_what_is_no_mesh_are_refused():
    lon, lat = [0, 10, 10, 0], [0, 0, 10, 10]
    with pytest.raises(ValueError, match=r"values must have shape \(..., 4\), not \(3,\)"):
        rondel.native_isolines(lon, lat, [[0, 1, 2]], [1, 2, 3], 0.5)
    with pytest.raises(rondel.InvalidInput, match="cells overlap"):
        rondel.native_isolines(lon, lat, [[0, 1, 2], [0, 1, 3]], [1, 2, 3, 4], 0.5)
    with pytest.raises(ValueError, match="none of 4 nodes"):
        rondel.native_bands(lon, lat, [[0, 1, 7]], [1, 2, 3, 4], 0.5)
