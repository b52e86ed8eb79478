# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Isolines and bands."""

import io
import itertools
import json

import clouds
import numpy as np
import pytest

import rondel

SITES = clouds.uniform(300)
HEIGHT = SITES[:, 2] + 0.2 * SITES[:, 0]
LEVELS = [-0.5, 0.25, 0.5]


@pytest.fixture(scope="module")
def tri():
    return rondel.delaunay(SITES)


def test_points_of_lines_have_the_value(tri):
    found = tri.isolines(HEIGHT, LEVELS)
    assert found.levels.tolist() == LEVELS
    for k, level in enumerate(LEVELS):
        (line,) = found.lines(k)
        assert np.array_equal(line[0], line[-1])
        assert np.abs(np.linalg.norm(line, axis=1) - 1).max() < 1e-15
        assert np.abs(tri.interpolate(HEIGHT, line, "linear") - level).max() < 1e-14
    assert found.is_closed.all()
    assert repr(found) == "<rondel.Isolines: 3 levels, 3 lines>"
    assert tri.isolines(HEIGHT, 5).lines(0) == []
    with pytest.raises(IndexError, match="3 is not in 0 to 2"):
        found.lines(3)


def area(ring):
    """Of what is to the left of a ring, by a fan of triangles; modulo the sphere."""
    total = 0.0
    for a, b in itertools.pairwise(ring[1:]):
        triple = np.dot(ring[0], np.cross(a, b))
        total += 2 * np.arctan2(triple, 1 + ring[0] @ a + a @ b + b @ ring[0])
    return total


def test_bands_cover_the_sphere(tri):
    found = tri.bands(HEIGHT, LEVELS)
    areas = [sum(area(ring) for rings in found.polygons(k) for ring in rings) for k in range(4)]
    assert np.isclose(np.cos(sum(areas) / 2), 1, atol=1e-9)  # a multiple of the sphere's 4 pi
    caps = [2 * np.pi * (1 - level / np.hypot(1, 0.2)) for level in LEVELS]
    wanted = [4 * np.pi - caps[0], caps[0] - caps[1], caps[1] - caps[2], caps[2]]
    assert np.allclose(np.mod(areas, 4 * np.pi), wanted, rtol=0.06)
    assert repr(found) == "<rondel.Bands: 4 bands, 4 polygons>"


def test_geojson(tri, tmp_path):
    lines = tri.isolines(HEIGHT, LEVELS)
    parsed = lines.to_geojson()
    assert [f["properties"]["level"] for f in parsed["features"]] == LEVELS
    assert {f["geometry"]["type"] for f in parsed["features"]} == {"MultiLineString"}
    bands = tri.bands(HEIGHT, LEVELS)
    bands.to_geojson(tmp_path / "bands.geojson")
    written = json.loads((tmp_path / "bands.geojson").read_text())
    assert [f["properties"]["high"] for f in written["features"]] == [*LEVELS, None]
    text = io.StringIO()
    bands.to_geojson(text, tolerance=1.0)
    coarse = json.loads(text.getvalue())
    assert len(str(coarse)) < len(str(written))
    with pytest.raises(ValueError, match=r"ends in \.geojson"):
        lines.to_geojson(tmp_path / "lines.json")


def test_missing_values_and_errors(tri):
    holes = np.ma.masked_less(HEIGHT, -0.4)
    assert len(tri.isolines(holes, -0.5).points) == 0
    with pytest.raises(ValueError, match=r"shape \(\.\.\., 300\)"):
        tri.isolines(HEIGHT[:5], 0)
    with pytest.raises(ValueError, match=r"shape \(300,\)"):
        tri.bands(np.stack([HEIGHT, HEIGHT]), 0)
    with pytest.raises(rondel.InvalidInput):
        tri.isolines(HEIGHT, [1, 0])


def test_pictures_and_pages(tri, tmp_path):
    plt = pytest.importorskip("matplotlib.pyplot")
    lines = tri.isolines(HEIGHT, LEVELS)
    ax = lines.plot(colors="red")
    (drawn,) = ax.collections
    assert len(drawn.get_segments()) >= len(lines.points)
    assert tri.isolines(HEIGHT, 5).plot(ax) is ax
    plt.close(ax.figure)
    tri.save_html(tmp_path / "page.html", HEIGHT, isolines=lines)
    assert 'id="data-isolines"' in (tmp_path / "page.html").read_text()
