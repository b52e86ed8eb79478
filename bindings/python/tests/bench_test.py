# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The script that compares with SciPy runs, and both classes give it the same areas."""

import importlib.util
import pathlib

import numpy as np
import pytest

import rondel

PATH = pathlib.Path(__file__).resolve().parents[1] / "bench" / "compare.py"


@pytest.fixture(scope="module")
def compare():
    spec = importlib.util.spec_from_file_location("compare", PATH)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_rows(compare):
    pytest.importorskip("scipy.spatial")
    cells = [float(cell.replace(",", "")) for cell in compare.ratios(8, 1)]
    assert len(cells) == 7
    assert min(cells) > 0
    assert list(compare.overhead(8, 1, None)) == ["over the C++ function inside"]


def test_both_do_the_same_work(compare):
    spatial = pytest.importorskip("scipy.spatial")
    points = compare.uniform(200)
    theirs = compare.diagram(spatial.SphericalVoronoi, points)
    ours = compare.diagram(rondel.SphericalVoronoi, points)
    assert np.allclose(ours.calculate_areas(), theirs.calculate_areas(), rtol=1e-9)
