# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Weights that are checked: faults that are planted are found where they are."""

import json

import numpy as np
import pytest

import rondel

SOURCE = rondel.CellSet.lonlat_grid(np.linspace(-180, 180, 13), np.linspace(-50, 90, 8))
TARGET = rondel.CellSet.named("healpix:1")


def weights_of(order=1, norm="fracarea"):
    return rondel.remap(SOURCE, TARGET, order=order, norm=norm)


def changed(remap, change):
    """The weights with other numbers, as arrays of a sparse matrix that `change` gets."""
    matrix = remap.weights.tocsr().copy()
    change(matrix)
    return rondel.Weights(matrix.indptr, matrix.indices, matrix.data, matrix.shape)


def test_right_weights_have_no_fault():
    for norm in ("fracarea", "destarea"):
        report = rondel.check_weights(weights_of(norm=norm), SOURCE, TARGET)
        assert report
        assert report.faults == ()
        found = report.comparison
        assert found.norm == norm
        assert (found.wrong, found.missing, found.needless) == (0, 0, 0)
        assert found.pieces == report.entries == found.errors.sum()
        assert found.max_error < 1e-13
        assert found.local_conservation < 1e-13
        assert found.global_conservation < 1e-13
        assert found.worst_rows == ()
        assert (report.rows, report.columns) == (48, 84)
    assert "no fault" in repr(report)
    assert rondel.check_weights(weights_of()).comparison is None


def test_reports_can_be_compared():
    remap = weights_of()
    first, second = (rondel.check_weights(remap, SOURCE, TARGET) for _ in range(2))
    assert first == second
    assert first.comparison == second.comparison
    assert hash(first) == hash(second)
    assert len({first, second, rondel.check_weights(remap)}) == 2
    other = rondel.check_weights(weights_of(norm="destarea"), SOURCE, TARGET)
    assert first != other
    assert first.comparison != other.comparison
    assert first.comparison != None  # noqa: E711 (what == says)


def test_a_scaled_weight_is_found_where_it_is():
    remap = weights_of()
    matrix = remap.weights.tocsr()
    entry = matrix.indptr[20]

    def scale(matrix):
        matrix.data[entry] *= 1.25

    report = rondel.check_weights(changed(remap, scale), SOURCE, TARGET)
    assert not report
    assert report.count("wrong weight") == 1
    (row,) = report.comparison.worst_rows
    assert (row.target, row.source, row.wrong) == (20, matrix.indices[entry], 1)
    assert row.given == pytest.approx(1.25 * row.exact, rel=1e-12)
    assert row.error == pytest.approx(0.25 * row.exact, rel=1e-12)
    assert row.sum - row.exact_sum == pytest.approx(row.error, rel=1e-12)
    lon, lat = rondel.lonlat(TARGET.centers[20])
    assert abs((row.lon - lon + 180) % 360 - 180) < 1
    assert abs(row.lat - lat) < 1
    # What is given away too much, by the exact areas.
    area = row.error * TARGET.areas[20] * remap.target_fractions[20]
    assert report.comparison.local_conservation == pytest.approx(
        area / SOURCE.areas[row.source], rel=1e-9
    )


def test_dropped_pieces_and_made_up_ones_are_told_apart():
    remap = weights_of()

    def drop(matrix):
        matrix.data[7] = 0

    assert rondel.check_weights(changed(remap, drop), SOURCE, TARGET).count("missing piece") == 1

    def move(matrix):
        row = np.searchsorted(matrix.indptr, 7, "right") - 1
        free = np.setdiff1d(np.arange(84), matrix.indices[slice(*matrix.indptr[row : row + 2])])
        matrix.indices[7] = free[0]

    report = rondel.check_weights(changed(remap, move), SOURCE, TARGET)
    assert report.count("missing piece") == report.count("needless weight") == 1


def test_files_say_what_they_are(tmp_path):
    path = tmp_path / "w.nc"
    for form in ("esmf", "scrip"):
        weights_of().to_netcdf(path, form)
        report = rondel.check_weights(path, SOURCE, "healpix:1")
        assert report
        assert report.normalization == report.comparison.norm == "fracarea"
        assert report.comparison.target_areas < 1e-12
    wrong = weights_of(norm="destarea")
    wrong._norm = "fracarea"
    wrong.to_netcdf(path)
    report = rondel.check_weights(path, SOURCE, TARGET)
    assert report.comparison.norm == "destarea"
    assert report.count("normalization") > 0
    assert report.count("wrong weight") == 0


def test_second_order_is_judged_by_sums(tmp_path):
    path = tmp_path / "w.nc"
    weights_of(order=2).to_netcdf(path)
    report = rondel.check_weights(path, SOURCE, TARGET)
    assert report.comparison.sums_only
    assert report.comparison.row_sums < 1e-12
    assert report


def test_wrong_calls_are_refused(tmp_path):
    remap = weights_of()
    with pytest.raises(ValueError, match="source and target are given together"):
        rondel.check_weights(remap, SOURCE)
    with pytest.raises(ValueError, match="source and target are exchanged"):
        rondel.check_weights(remap, TARGET, SOURCE)
    with pytest.raises(ValueError, match="the cells are 84 sources and 12 targets"):
        rondel.check_weights(remap, SOURCE, "healpix:0")
    with pytest.raises(ValueError, match="tolerance"):
        rondel.check_weights(remap, SOURCE, TARGET, tolerance=float("nan"))
    with pytest.raises(OSError, match=r"none\.nc"):
        rondel.check_weights(tmp_path / "none.nc")


def test_sources_give_to_each_of_targets_that_overlap(tmp_path):
    boxes = [[(10, 0), (60, 0), (60, 40), (10, 40)], [(30, 10), (80, 10), (80, 50), (30, 50)]]
    rings = {"type": "FeatureCollection", "features": []}
    for box in boxes:
        ring = [list(map(float, position)) for position in (*box, box[0])]
        geometry = {"type": "Polygon", "coordinates": [ring]}
        rings["features"].append({"type": "Feature", "properties": {}, "geometry": geometry})
    path = tmp_path / "boxes.geojson"
    path.write_text(json.dumps(rings))
    target = rondel.CellSet.read(path, overlap="keep")
    remap = rondel.remap("grid:5", target, overlap="each", norm="destarea")
    assert remap.source_fractions.max() > 1.9
    remap.to_netcdf(tmp_path / "weights.nc")
    for weights in (remap, tmp_path / "weights.nc"):
        assert rondel.check_weights(weights, "grid:5", target, overlap="each")
        assert rondel.check_weights(weights, overlap="each")
        assert rondel.check_weights(weights).count("source fraction") > 0
    with pytest.raises(rondel.InvalidInput, match=r"overlap='each' in Python"):
        rondel.remap("grid:5", target)
