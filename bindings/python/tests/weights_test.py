# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Sparse weights: what they are to NumPy and SciPy, missing values, files."""

import copy
import os
import pickle

import clouds
import numpy as np
import pytest
import scipy.sparse

import rondel

SITES = clouds.uniform(100)
TARGETS = clouds.uniform(40, seed=1)
WEIGHTS = rondel.delaunay(SITES).weights(TARGETS)
VALUES = np.random.default_rng(2).normal(size=(4, 5, 100))
# Rows of two, none, one and three entries.
SMALL = rondel.Weights([0, 2, 2, 3, 6], [0, 3, 2, 1, 2, 3], [0.5, 0.5, 1, 0.2, 0.3, 0.5], (4, 4))


def test_arrays_are_those_of_a_matrix():
    matrix = WEIGHTS.tocsr()
    assert isinstance(matrix, scipy.sparse.csr_matrix)
    assert matrix.shape == WEIGHTS.shape == (40, 100)
    assert np.allclose(matrix @ SITES[:, 0], WEIGHTS.apply(SITES[:, 0]), atol=1e-15)
    assert WEIGHTS.indptr.dtype == np.int64
    assert WEIGHTS.indices.dtype == np.int32
    for array in (WEIGHTS.indptr, WEIGHTS.indices, WEIGHTS.data):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
    matrix.data[:] = 0  # a copy
    assert WEIGHTS.data.any()


def test_apply_and_products():
    dense = WEIGHTS.tocsr().toarray()
    assert np.allclose(WEIGHTS.apply(VALUES), VALUES @ dense.T, atol=1e-14)
    assert WEIGHTS.apply(VALUES[0, 0]).shape == (40,)
    assert WEIGHTS.apply(VALUES[:0]).shape == (0, 5, 40)
    assert np.array_equal(WEIGHTS.apply(VALUES, threads=1), WEIGHTS.apply(VALUES))
    assert np.array_equal(WEIGHTS @ VALUES[0, 0], WEIGHTS.apply(VALUES[0, 0]))
    assert np.allclose(WEIGHTS @ SITES, dense @ SITES, atol=1e-15)
    assert (WEIGHTS @ np.swapaxes(VALUES, 1, 2)).shape == (4, 40, 5)
    turned = VALUES.transpose(1, 2, 0)[:, :, 0]  # not contiguous
    assert np.allclose(WEIGHTS.apply(turned), turned @ dense.T, atol=1e-14)
    assert np.array_equal(WEIGHTS.apply(np.arange(100)), WEIGHTS.apply(np.arange(100.0)))


def test_missing_values():
    nan = np.nan

    def apply(values, **options):
        return SMALL.apply(values, **options).tolist()

    assert np.array_equal(SMALL.apply([1, 2, 3, 4]), [2.5, nan, 3, 3.3], equal_nan=True)
    assert apply([1, 2, 3, 4], fill=-1) == [2.5, -1, 3, 3.3]
    assert apply([1, nan, 3, 4], fill=-1) == [2.5, -1, 3, -1]
    # The weights that are left: 0.3 and 0.5 of 1.
    assert apply([1, nan, 3, 4], fill=-1, skipna=True) == [2.5, -1, 3, pytest.approx(2.9 / 0.8)]
    assert apply([nan, 2, nan, 4], fill=-1, skipna=True) == [4, -1, -1, pytest.approx(2.4 / 0.7)]
    assert apply([nan, 2, nan, 4], fill=-1, skipna=True, max_missing=0.4) == [
        -1,
        -1,
        -1,
        pytest.approx(2.4 / 0.7),
    ]
    assert apply([nan] * 4, fill=-1, skipna=True) == [-1] * 4
    masked = np.ma.masked_equal([1.0, 2, 3, 4], 2)
    assert apply(masked, fill=-1) == apply([1, nan, 3, 4], fill=-1)
    assert apply(np.float32([1, 2, 3, np.inf]), fill=-1) == [np.inf, -1, 3, np.inf]


def test_files(tmp_path):
    path = tmp_path / "weights.npz"
    WEIGHTS.save(path)
    loaded = rondel.Weights.load(path)
    assert loaded.shape == WEIGHTS.shape
    assert np.array_equal(loaded.apply(VALUES), WEIGHTS.apply(VALUES))
    assert loaded.is_of(SITES, TARGETS)
    assert (scipy.sparse.load_npz(path) != WEIGHTS.tocsr()).nnz == 0
    theirs = tmp_path / "theirs.npz"
    scipy.sparse.save_npz(theirs, WEIGHTS.tocsr())
    loaded = rondel.Weights.load(theirs)
    assert np.array_equal(loaded.apply(VALUES), WEIGHTS.apply(VALUES))
    assert (loaded.sites_hash, loaded.targets_hash) == (0, 0)
    assert sorted(os.listdir(tmp_path)) == ["theirs.npz", "weights.npz"]
    scipy.sparse.save_npz(theirs, WEIGHTS.tocsr().tocsc())
    np.savez(path, data=np.ones(3))
    for wrong in (theirs, path):
        with pytest.raises(ValueError, match="no matrix in compressed rows"):
            rondel.Weights.load(wrong)
    with pytest.raises(FileNotFoundError) as caught:
        WEIGHTS.save(tmp_path / "none" / "weights.npz")
    assert caught.value.filename == str(tmp_path / "none" / "weights.npz")


def test_whose_they_are():
    assert WEIGHTS.is_of()
    assert WEIGHTS.is_of(SITES)
    assert WEIGHTS.is_of(targets=TARGETS.reshape(5, 8, 3))
    assert WEIGHTS.is_of(SITES.tolist(), TARGETS)
    assert not WEIGHTS.is_of(SITES[::-1])
    assert not WEIGHTS.is_of(SITES, TARGETS[:-1])
    assert not SMALL.is_of(SITES)
    assert rondel.point_set_hash([[0.0, 0, 1]]) == rondel.point_set_hash([[-0.0, 0, 1]])
    with pytest.raises(ValueError, match=r"points must have shape \(..., 3\)"):
        rondel.point_set_hash([1, 2])


@pytest.mark.parametrize(
    "copied", [copy.copy, copy.deepcopy, lambda w: pickle.loads(pickle.dumps(w))]
)
def test_copies(copied):
    other = copied(WEIGHTS)
    assert np.array_equal(other.apply(VALUES), WEIGHTS.apply(VALUES))
    assert other.is_of(SITES, TARGETS)


def test_what_they_say():
    assert repr(SMALL) == "<rondel.Weights: 4 targets, 4 sites, 6 entries>"
    assert "<td style='text-align:left'>4 targets</td>" in SMALL._repr_html_()
    assert repr(rondel.Weights([0], [], [], (0, 3))).endswith("0 targets, 3 sites, 0 entries>")


def test_wrong_arrays():
    for arrays, message in (
        (([0, 2], [0, 1], [1, 1], (2, 2)), r"indptr must have shape \(3,\)"),
        (([0, 1, 3], [0, 1], [1, 1], (2, 2)), "offsets do not go from 0 to 2"),
        (([0, 2, 1, 2], [0, 1], [1, 1], (3, 2)), "offsets decrease"),
        (([0, 1, 2], [0, 2], [1, 1], (2, 2)), "column 2 of 2"),
        (([0, 1, 2], [0, 1], [1], (2, 2)), "values has 1 numbers instead of 2"),
        (([0, 1, 2], [0, -1], [1, 1], (2, 2)), "indices has numbers that are negative"),
    ):
        with pytest.raises(ValueError, match=message):
            rondel.Weights(*arrays)
    with pytest.raises(TypeError, match="indices must be integers"):
        rondel.Weights([0, 1], [0.5], [1], (1, 1))
    with pytest.raises(ValueError, match=r"values must have shape \(..., 100\), not \(3,\)"):
        WEIGHTS.apply(np.ones(3))
    with pytest.raises(ValueError, match="max_missing must be from 0 to 1"):
        WEIGHTS.apply(VALUES, skipna=True, max_missing=2)


def test_files_of_another_kind_are_named(tmp_path):
    path = tmp_path / "weights.nc"
    WEIGHTS.to_netcdf(path)
    with pytest.raises(
        ValueError, match=r"weights.nc: no .npz file; rondel.read_weights\(\) reads"
    ):
        rondel.Weights.load(path)
    wide = tmp_path / "wide.npz"
    arrays = {"indptr": np.zeros(73, int), "indices": np.zeros(0, int), "data": np.zeros(0)}
    np.savez(wide, **arrays, shape=np.array([72, 2**40]), format=np.array(b"csr"))
    with pytest.raises(
        ValueError, match=r"wide.npz: shape .* must have from 0 to 2147483647 columns"
    ):
        rondel.Weights.load(wide)


def test_negative_areas_are_refused(tmp_path):
    areas = np.ones(WEIGHTS.shape[1])
    areas[3] = -1
    with pytest.raises(
        rondel.InvalidInput, match=r"site_areas\[3\] is -1.0, which is no area"
    ) as caught:
        WEIGHTS.to_netcdf(tmp_path / "weights.nc", site_areas=areas)
    assert caught.value.index == 3
    assert not (tmp_path / "weights.nc").exists()
