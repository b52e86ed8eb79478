# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""SciPy's own tests of SphericalVoronoi, as installed with SciPy, with our class in its place.

DEVIATIONS lists what is different on purpose. Each of these tests must fail, and only these may.
"""

import importlib.util
import pathlib
import re

import pytest

import rondel

scipy_spatial = pytest.importorskip("scipy.spatial")

DEVIATIONS = {
    r"test_sort_vertices_of_regions_flattened": "expects Qhull's numbers of the faces; the diagram "
    "is the same (voronoi_test.py: test_the_diagram_is_that_of_scipy)",
    r"test_rank_deficient\[.*-3-.*\]": "SciPy refuses sites on one great circle and single sites; "
    "they have a diagram like all others",
}


def load_with_our_class():
    """The module of SciPy's tests, to which scipy.spatial.SphericalVoronoi is ours."""
    path = pathlib.Path(scipy_spatial.__file__).parent / "tests" / "test_spherical_voronoi.py"
    if not path.exists():
        pytest.skip("SciPy is installed without its tests", allow_module_level=True)
    spec = importlib.util.spec_from_file_location("scipy_test_spherical_voronoi", path)
    module = importlib.util.module_from_spec(spec)
    theirs = scipy_spatial.SphericalVoronoi
    scipy_spatial.SphericalVoronoi = rondel.SphericalVoronoi
    try:
        spec.loader.exec_module(module)
    finally:
        scipy_spatial.SphericalVoronoi = theirs
    return module


_module = load_with_our_class()
TestSphericalVoronoi = _module.TestSphericalVoronoi


def test_our_class_is_tested():
    assert _module.SphericalVoronoi is rondel.SphericalVoronoi
    assert scipy_spatial.SphericalVoronoi is not rondel.SphericalVoronoi


@pytest.fixture(autouse=True)
def _expect_deviations(request):
    for pattern, reason in DEVIATIONS.items():
        if re.fullmatch(pattern, request.node.name):
            request.applymarker(pytest.mark.xfail(strict=True, reason=reason))
