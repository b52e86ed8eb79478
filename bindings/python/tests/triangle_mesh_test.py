# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Meshes of triangles: their borders, and files that come back bit by bit."""

import math
import pickle
import warnings
from xml.etree import ElementTree

import numpy as np
import pytest

import rondel
import rondel.mesh
from rondel.mesh import TriangleMesh, read_triangles

FORMATS = ("msh", "14", "gr3", "ll", "2dm", "nc")


@pytest.fixture(scope="module")
def mesh():
    """An ocean around the pole with an island, open where x is positive."""
    rng = np.random.default_rng(5)
    lat = np.degrees(np.arcsin(rng.uniform(0.4, 1, 400)))
    tri = rondel.delaunay_lonlat(rng.uniform(-180, 180, 400), lat)
    solid = tri.simplices[~tri.ghost]
    middle = tri.points[solid].mean(axis=1)
    kept = solid[(np.hypot(middle[:, 0] - 0.3, middle[:, 1]) > 0.1) & (middle[:, 2] > 0.5)]
    edges = np.concatenate([kept[:, [0, 1]], kept[:, [1, 2]], kept[:, [2, 0]]])
    has_reverse = (edges[:, None, ::-1] == edges[None]).all(axis=2).any(axis=1)
    coast = edges[
        ~has_reverse
        & ((tri.points[edges].sum(axis=1)[:, 0] < 0) | (tri.points[edges, 2].min(axis=1) > 0.7))
    ]
    kept_nodes = len(np.unique(kept))
    return TriangleMesh(tri.lonlat, kept, coast=coast, depths=rng.uniform(1, 5000, kept_nodes))


def same(one, other, names=("points", "triangles", "depths")):
    for name in names:
        assert np.array_equal(getattr(one, name), getattr(other, name)), name
    for a, b in zip(one.boundary, other.boundary, strict=True):
        assert (a.kind, a.type, a.nodes.tolist()) == (b.kind, b.type, b.nodes.tolist())


@pytest.mark.parametrize("ending", FORMATS)
def test_files_come_back(mesh, ending, tmp_path):
    path = tmp_path / f"mesh.{ending}"
    mesh.write(path)
    found = read_triangles(path)
    same(found, mesh)
    if ending != "msh":
        assert np.array_equal(found.lonlat, mesh.lonlat)
    assert {segment.kind for segment in mesh.boundary} == {"open", "land", "island"}


def test_what_files_do_not_hold_is_told(mesh, tmp_path):
    levels = TriangleMesh(mesh.lonlat, mesh.triangles, depths=mesh.depths, levels=[0, 10, 9000])
    with pytest.warns(UserWarning, match="the 3 levels are left out"):
        levels.write(tmp_path / "mesh.gr3")
    assert read_triangles(tmp_path / "mesh.gr3").levels is None
    with pytest.warns(UserWarning, match="open segments are left out"):
        mesh.write(tmp_path / "mesh", format="fesom")
    assert "open" not in {segment.kind for segment in read_triangles(tmp_path / "mesh").boundary}


def test_fesom_is_a_folder(mesh, tmp_path):
    levels = TriangleMesh(mesh.lonlat, mesh.triangles, depths=mesh.depths, levels=[0, 10, 9000])
    levels.write(tmp_path / "mesh", format="fesom")
    assert {path.name for path in (tmp_path / "mesh").iterdir()} == {
        "nod2d.out",
        "elem2d.out",
        "aux3d.out",
    }
    found = read_triangles(tmp_path / "mesh")
    same(found, levels, ("points", "lonlat", "triangles", "depths", "levels"))


def test_pickles_are_the_same(mesh):
    again = pickle.loads(pickle.dumps(mesh))
    same(again, mesh, ("points", "lonlat", "triangles", "depths"))
    assert again.levels is None
    with pytest.raises(ValueError, match="read-only"):
        again.points[0] = 0


def test_degrees_are_computed_for_points(mesh):
    points = TriangleMesh(mesh.points, mesh.triangles)
    assert np.allclose(points.lonlat, mesh.lonlat)
    assert points.depths is None
    assert not points.pinched_nodes.size


def test_wrong_input_is_named(tmp_path):
    lonlat = [[0, 0], [1, 0], [0, 1]]
    with pytest.raises(rondel.InvalidInput, match="triangle 0 is clockwise") as caught:
        TriangleMesh(lonlat, [[0, 2, 1]])
    assert caught.value.index == 0
    with pytest.raises(rondel.InvalidInput, match="triangle 0 has the corner 3"):
        TriangleMesh(lonlat, [[0, 1, 3]])
    with pytest.raises(rondel.InvalidInput, match="there are 2 depths for 3 nodes"):
        TriangleMesh(lonlat, [[0, 1, 2]], depths=[1, 2])
    square, halves = [*lonlat, [1, 1]], [[0, 1, 2], [1, 3, 2]]
    assert len(TriangleMesh(square, halves, coast=[[1, 0], [2, 0]]).boundary) == 2
    for pair, text in (
        ([0, 99], "coast 1 has the node 99, and there are 4 points"),
        ([2, 1], "coast 1 joins the nodes 2 and 1, which is an edge of two triangles"),
        ([0, 3], "coast 1 joins the nodes 0 and 3, which is not an edge of a triangle"),
        ([3, 3], "coast 1 joins the nodes 3 and 3, which is not an edge of a triangle"),
    ):
        with pytest.raises(rondel.InvalidInput, match=text) as caught:
            TriangleMesh(square, halves, coast=[[0, 1], pair])
        assert caught.value.index == 1
    with pytest.raises(ValueError, match="triangles must have shape"):
        TriangleMesh(lonlat, [0, 1, 2])
    with pytest.raises(OSError, match="unknown ending"):
        TriangleMesh(lonlat, [[0, 1, 2]]).write(tmp_path / "mesh.ply")
    (tmp_path / "fort.14").write_text("x\n1 3\n1 0 95 0\n")
    with pytest.raises(OSError, match=r"fort.14:3: latitude 95 is outside"):
        read_triangles(tmp_path / "fort.14")


def test_remarks_are_warnings(tmp_path):
    (tmp_path / "a.gr3").write_text("x\n1 3\n1 0 0 1\n2 1 0 1\n3 0 1 1\n1 3 1 3 2\n")
    with pytest.warns(UserWarning, match="1 of 1 triangles were clockwise"):
        assert read_triangles(tmp_path / "a.gr3").triangles.tolist() == [[0, 1, 2]]


def sides_of(mesh):
    a, b, c = mesh.points[mesh.triangles].transpose(1, 0, 2)
    return np.array([np.linalg.norm(p - q, axis=1) for p, q in ((b, c), (c, a), (a, b))])


def test_an_ocean_has_the_spacing_and_the_angles():
    shapely = pytest.importorskip("shapely")
    sea, island = shapely.box(170, -10, 195, 15), shapely.box(178, 0, 183, 4)

    def spacing(places):
        return np.where(places[:, 2] > 0.05, 0.02, 0.04)

    mesh = rondel.mesh.triangles(
        island, area=sea, spacing=spacing, gradient=0.2, tolerance=0, depths=lambda p: 100 * p[:, 2]
    )
    sides = sides_of(mesh)
    assert sides.max() <= 1.5 * 0.04
    assert sides.min() > 0.005
    cosines = (np.roll(sides, 1, 0) ** 2 + np.roll(sides, 2, 0) ** 2 - sides**2) / (
        2 * np.roll(sides, 1, 0) * np.roll(sides, 2, 0)
    )
    assert np.degrees(np.arccos(cosines.max(axis=0))).min() > 26.4
    assert np.array_equal(mesh.depths, 100 * mesh.points[:, 2])
    assert {segment.kind for segment in mesh.boundary} == {"open", "island"}
    same(pickle.loads(pickle.dumps(mesh)), mesh)


@pytest.mark.parametrize(
    ("west", "south"), [(2, 40), (179, -17), (-180, 89)], ids=["inland", "antimeridian", "pole"]
)
def test_a_small_area_has_spacings_as_small(west, south):
    shapely = pytest.importorskip("shapely")
    size = 360 if south == 89 else 2
    area = shapely.box(west, south, west + size, min(south + 2, 90))
    kilometer = 1 / 6371.229
    lonlat = np.radians([west + 1, south + 0.9])
    center = np.array(
        [
            math.cos(lonlat[1]) * math.cos(lonlat[0]),
            math.cos(lonlat[1]) * math.sin(lonlat[0]),
            math.sin(lonlat[1]),
        ]
    )
    farthest = []

    def spacing(places):
        distances = np.linalg.norm(places - center, axis=1)
        farthest.append(distances.max())
        return np.minimum(20 * kilometer, 0.5 * kilometer + 0.1 * distances)

    mesh = rondel.mesh.triangles(area=area, spacing=spacing, gradient=0.1)
    assert max(farthest) < math.radians(3)  # the spacing is asked for around the area alone
    ends = mesh.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    lengths = np.linalg.norm(mesh.points[ends[:, 0]] - mesh.points[ends[:, 1]], axis=1)
    assert (lengths <= 1.55 * spacing(mesh.points)[ends].min(axis=1)).all()
    assert lengths.min() < 0.7 * kilometer


def test_steps_of_the_raster_of_an_area():
    shapely = pytest.importorskip("shapely")
    area, places = shapely.box(0, 0, 1, 1), []

    def spacing(at):
        places.append(len(at))
        return np.full(len(at), 0.01)

    rondel.mesh.triangles(area=area, spacing=spacing, raster_steps=7)
    assert places == [8 * 8]
    rondel.mesh.triangles(area=shapely.box(-60, -10, 60, 10), spacing=spacing, raster_steps=8)
    assert places[1:] == [6 * 9 * 9]
    with pytest.raises(ValueError, match="from 1 to 4096, not 5000"):
        rondel.mesh.triangles(area=area, spacing=spacing, raster_steps=5000)


def test_narrow_water_is_filled_and_small_parts_are_left_out():
    shapely = pytest.importorskip("shapely")
    land = [shapely.box(8, 40, 10, 44.9), shapely.box(8, 45.1, 10, 50)]
    given = {"area": shapely.box(0, 40, 12, 50), "spacing": 0.01}
    made = [
        rondel.mesh.triangles(land, **given),
        rondel.mesh.triangles(land, **given, fill_narrow=0.5),
        rondel.mesh.triangles(land, **given, fill_narrow=0.5, smallest_part=0.5),
    ]
    for mesh in made:
        sides = sides_of(mesh)
        shortest, longest = mesh.quality.shortest_edge, mesh.quality.longest_edge
        assert np.allclose([shortest, longest], [sides.min(), sides.max()], rtol=1e-3)
    assert made[0].quality.shortest_edge < 0.0036 < 0.004 < made[1].quality.shortest_edge
    assert made[1].lonlat[:, 0].max() > 11
    assert made[2].lonlat[:, 0].max() < 8.1
    with pytest.raises(ValueError, match="from 0 to 1"):
        rondel.mesh.triangles(land, **given, fill_narrow=2)


def test_arguments_without_effect_are_refused():
    shapely = pytest.importorskip("shapely")
    given = {"area": shapely.box(0, 40, 12, 50)}
    for spacing in ("0.02", True):
        with pytest.raises(TypeError, match="neither a number nor a function"):
            rondel.mesh.triangles(**given, spacing=spacing)
    with pytest.raises(TypeError, match="gradient limits the growth of spacing"):
        rondel.mesh.triangles(**given, gradient=0.2)
    with pytest.raises(TypeError, match="depths is no function"):
        rondel.mesh.triangles(**given, spacing=0.05, depths=np.ones(3))


def test_lines_that_cross_make_a_node():
    shapely = pytest.importorskip("shapely")
    cross = shapely.MultiLineString([[(-3, 0), (3, 0)], [(0, -3), (0, 3)]])
    mesh = rondel.mesh.triangles(area=shapely.box(-5, -5, 5, 5), lines=cross, spacing=0.05)
    assert (mesh.points == [1, 0, 0]).all(axis=1).sum() == 1


def test_lines_outside_are_told():
    shapely = pytest.importorskip("shapely")
    sea = shapely.box(-5, -5, 5, 5)
    inside, outside = shapely.LineString([(-1, 0), (1, 0)]), shapely.Point(7, 0)
    with pytest.warns(UserWarning, match="^1 feature of lines is outside of .*, the first one 1$"):
        rondel.mesh.triangles(area=sea, lines=[inside, outside], spacing=0.05)
    with pytest.warns(UserWarning, match="^2 features of lines are outside"):
        rondel.mesh.triangles(area=sea, lines=[outside, inside, outside], spacing=0.05)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        rondel.mesh.triangles(area=sea, lines=[None, inside], spacing=0.05)


def test_what_cannot_be_filled():
    shapely = pytest.importorskip("shapely")
    sea = shapely.box(0, 0, 10, 10)
    with pytest.raises(ValueError, match="the land covers the area"):
        rondel.mesh.triangles(sea, area=sea)
    none = ([], {"type": "FeatureCollection", "features": []}, [None], shapely.Polygon())
    for area in (*none, shapely.LineString([(0, 0), (1, 1)])):
        with pytest.raises(ValueError, match="the area has no polygon"):
            rondel.mesh.triangles(area=area, spacing=0.1)
    assert len(rondel.mesh.triangles([], lines=[], spacing=0.5).boundary) == 0
    with pytest.raises(ValueError, match=r"asks for about .* nodes, more than the 715827882"):
        rondel.mesh.triangles(area=sea, spacing=1e-8)
    with pytest.raises(ValueError, match="the area is nowhere wider than a quarter of the spacing"):
        rondel.mesh.triangles(area=sea, spacing=3)
    with pytest.raises(ValueError, match="not between 0 and pi"):
        rondel.mesh.triangles(sea, spacing=-1)
    with pytest.raises(ValueError, match="from 0 to 33 degrees, not 40"):
        rondel.mesh.triangles(sea, smallest_angle=40)
    with pytest.raises(TypeError, match="coast, area or spacing"):
        rondel.mesh.triangles()
    for gradient in (-1, 0, math.nan, math.inf):
        with pytest.raises(ValueError, match="gradient must be positive and finite, not"):
            rondel.mesh.triangles(sea, spacing=lambda p: 0.5 + 0 * p[:, 0], gradient=gradient)
        with pytest.raises(ValueError, match="gradient must be positive and finite, not"):
            rondel.mesh.scvt(spacing=lambda p: 0.5 + 0 * p[:, 0], gradient=gradient)
    for value in (math.nan, math.inf):
        with pytest.raises(rondel.InvalidInput, match=f"depths are {value} at node 3") as caught:
            rondel.mesh.triangles(
                sea, spacing=0.5, depths=lambda p, v=value: np.where(np.arange(len(p)) < 3, 1, v)
            )
        assert caught.value.index == 3
    for depths in (lambda p: p[:3, 0], lambda p: p[:, :1]):
        with pytest.raises(ValueError, match=r"depths must have shape \(\d+,\), not"):
            rondel.mesh.triangles(sea, spacing=0.5, depths=depths)


@pytest.mark.parametrize("form", ["gmsh", "gmsh2"])
def test_meshio_reads_and_writes_the_same(mesh, form, tmp_path):
    meshio = pytest.importorskip("meshio")
    mesh.write(tmp_path / "mesh.msh", format=form)
    read = meshio.read(tmp_path / "mesh.msh")
    assert np.array_equal(read.points, mesh.points)
    assert np.array_equal(read.cells_dict["triangle"], mesh.triangles)
    assert np.array_equal(read.point_data["depth"].ravel(), mesh.depths)
    lines = np.concatenate([cells.data for cells in read.cells if cells.type == "line"])
    mine = mesh.to_meshio()
    assert np.array_equal(
        lines, np.concatenate([cells.data for cells in mine.cells if cells.type == "line"])
    )
    # meshio 5.3 writes depths as "np.float64(5.0)", which no program reads.
    mine.point_data.clear()
    mine.write(tmp_path / "theirs.msh", file_format="gmsh22", binary=False)
    same(read_triangles(tmp_path / "theirs.msh"), mesh, ("points", "triangles"))


def test_pictures_are_svg(mesh, tmp_path):
    mesh.quality_picture(tmp_path / "mesh.svg", num_worst=7)
    root = ElementTree.parse(tmp_path / "mesh.svg").getroot()
    assert root.tag == "{http://www.w3.org/2000/svg}svg"
    titles = [title.text for title in root.iter("{http://www.w3.org/2000/svg}title")]
    assert len(titles) == 7
    assert f": {mesh.quality.smallest_angle:.2f} degrees, at longitude " in titles[0]


@pytest.mark.parametrize("west", [170.0, -190.0, 350.0, 10.0])
@pytest.mark.parametrize("kind", ["shapely", "geojson"])
def test_longitudes_are_in_the_turn_of_the_input(west, kind):
    shapely = pytest.importorskip("shapely")
    box = shapely.box(west, -5, west + 30, 5)
    island = shapely.box(west + 12 - 360, -2, west + 15 - 360, 2)
    area, coast = (
        (box, island) if kind == "shapely" else map(shapely.geometry.mapping, (box, island))
    )
    mesh = rondel.mesh.triangles(coast, area=area, spacing=math.radians(3))
    assert west - 1e-12 < mesh.lonlat[:, 0].min()
    assert mesh.lonlat[:, 0].max() < west + 30 + 1e-12
    assert [west + 30, 5] in mesh.lonlat.tolist()
    # Without an area, those of the coast decide.
    around = rondel.mesh.triangles(box, spacing=math.radians(20))
    turn = -180 if west == 10 else 0 if west == 170 else west
    assert turn - 1e-12 < around.lonlat[:, 0].min()
    assert around.lonlat[:, 0].max() < turn + 360 + 1e-12
    made = rondel.constrained_delaunay(area)
    assert (made.lonlat[:, 0].min(), made.lonlat[:, 0].max()) == (west, west + 30)
    assert np.array_equal(pickle.loads(pickle.dumps(made)).lonlat, made.lonlat)


def test_flat_triangles_are_left_out(tmp_path):
    steps = np.linspace(-20, 20, 9)
    lonlat = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    points = rondel.unit_vectors(*lonlat.T)
    faces = rondel.delaunay(points).simplices
    faces = faces[np.linalg.det(points[faces]) > -1e-9]  # the others are beyond the hull

    def areas(triangles):
        a, b, c = np.moveaxis(lonlat[triangles], 1, 0)
        return np.linalg.det(np.stack([b - a, c - a], axis=-1))

    flat = areas(faces) == 0
    assert flat.any()
    with pytest.raises(rondel.InvalidInput, match="has no area in degrees"):
        TriangleMesh(lonlat, faces).write(tmp_path / "flat.14")
    kept = rondel.mesh.leave_out_flat(lonlat, faces, constraints=[[0, 80]])
    assert np.array_equal(kept, faces[~flat])
    assert areas(kept).sum() == pytest.approx(2 * 40 * 40)
    TriangleMesh(lonlat, kept).write(tmp_path / "mesh.14")
    assert np.array_equal(read_triangles(tmp_path / "mesh.14").triangles, kept)
    with pytest.raises(rondel.InvalidInput, match="triangle 1 has a corner that is no node"):
        rondel.mesh.leave_out_flat(lonlat, [[0, 1, 9], [0, 1, 81]])
