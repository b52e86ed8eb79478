# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Pages with a globe: what they carry, and notebooks."""

import base64
import html
import json
import re
import sys
import types
import zlib

import clouds
import numpy as np
import pytest

import rondel


def about(page):
    return json.loads(re.search(r'id="about">(.*?)</script>', page, re.S)[1])


def array(page, name, dtype):
    text = re.search(rf'id="data-{name}">(.*?)</script>', page, re.S)[1]
    planes = np.frombuffer(zlib.decompress(base64.b64decode(text)), np.uint8)
    return planes.reshape(np.dtype(dtype).itemsize, -1).T.copy().view(dtype).ravel()


@pytest.fixture
def tri():
    return rondel.delaunay(clouds.uniform(60))


def saved(tmp_path, thing, *args, **options):
    path = tmp_path / "globe.html"
    thing.save_html(path, *args, **options)
    return path.read_text("utf-8")


def test_a_page_carries_the_arrays(tmp_path, tri):
    page = saved(tmp_path, tri)
    assert np.array_equal(array(page, "faces", "<u4").reshape(-1, 3), tri.simplices)
    assert np.array_equal(array(page, "areas", "<f8"), tri.voronoi().areas)
    assert about(page)["show"] == "delaunay"
    assert about(saved(tmp_path, tri.voronoi()))["show"] == "voronoi"


def test_values_and_properties(tmp_path, tri):
    values = np.arange(60.0)
    values[7] = np.nan
    names = [f'site "{i}" ü' for i in range(60)]
    properties = {"name": names, "size": np.arange(60)}
    page = saved(tmp_path, tri, values, name="height", properties=properties, title="A & B")
    assert np.array_equal(array(page, "values", "<f8"), values, equal_nan=True)
    said = about(page)
    assert (said["fill"], said["valueName"], said["show"]) == ("values", "height", "voronoi")
    assert [column["name"] for column in said["columns"]] == ["name", "size"]
    assert bytes(array(page, "column0", "u1")).decode() == "".join(names)
    assert "<title>A &amp; B</title>" in page


def test_circles_and_view(tmp_path):
    centers = [[0, 0], [90, 0], [180, 0], [270, 0], [0, 90], [0, -90]]
    power = rondel.power_diagram(centers, 10)
    page = saved(tmp_path, power, circles=True, sites=False, show="both", view=(20, 30))
    said = about(page)
    assert said["circles"]
    assert not said["showSites"]
    assert (said["show"], said["view"]) == ("both", [20, 30])
    assert np.allclose(array(page, "radii", "<f8"), np.radians(10))


def test_wrong_arguments(tmp_path, tri):
    with pytest.raises(ValueError, match="shape"):
        tri.save_html(tmp_path / "a.html", [1, 2])
    with pytest.raises(ValueError, match="'all'"):
        tri.save_html(tmp_path / "a.html", show="all")
    with pytest.raises(ValueError, match="59 values"):
        tri.save_html(tmp_path / "a.html", properties={"name": range(59)})
    with pytest.raises(FileNotFoundError):
        tri.save_html(tmp_path / "none" / "a.html")
    assert list(tmp_path.iterdir()) == []


def test_a_notebook_shows_the_same_page_in_a_frame(tmp_path, tri, monkeypatch):
    shown = []
    display = types.ModuleType("IPython.display")
    display.HTML = lambda text: shown.append(text) or "shown"
    monkeypatch.setitem(sys.modules, "IPython", types.ModuleType("IPython"))
    monkeypatch.setitem(sys.modules, "IPython.display", display)
    assert tri.view(height=300, title="Sites") == "shown"
    frame = re.fullmatch(
        r'<div><iframe srcdoc="([^"]*)" title="Sites" style="([^"]*)"></iframe></div>', shown[0]
    )
    assert "height: 300px" in frame[2]
    assert html.unescape(frame[1]) == saved(tmp_path, tri, title="Sites")


def test_ipython_is_needed_for_frames_alone(tri, monkeypatch):
    monkeypatch.setitem(sys.modules, "IPython", None)
    with pytest.raises(ImportError):
        tri.view()
