# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Weights applied to arrays of Dask, one block of the targets at a time.

Only what is called with an array of Dask imports it.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Hashable, Mapping
from importlib import import_module
from typing import Any, TypeAlias

import numpy as np

from ._amounts import WeightsOfSums
from ._second_order import SecondOrderWeights
from ._weights import Weights

AnyWeights: TypeAlias = Weights | SecondOrderWeights | WeightsOfSums
# The lengths of the blocks along the dimensions of the targets.
OutputChunks: TypeAlias = int | str | tuple[Any, ...] | Mapping[Hashable, Any] | None


def in_blocks(
    values: Any,
    weights: AnyWeights,
    num_source_dims: int,
    shape: tuple[int, ...],
    dims: tuple[Hashable, ...],
    output_chunks: OutputChunks,
    apply: Callable[..., Any],
    dtype: Any,
) -> Any:
    """The lazy values at targets of a shape. Each block is ``apply(values, weights)`` of the rows
    of its own targets, with these in one axis, for a block of the leading axes of `values`.
    """
    array: Any = import_module("dask.array")
    delayed: Any = import_module("dask").delayed
    num_leading = values.ndim - num_source_dims
    values = values.rechunk(dict.fromkeys(range(num_leading, values.ndim), -1))
    leading = values.chunks[:num_leading]
    chunks = _chunks_of(output_chunks, shape, dims, values.shape[:num_leading], leading, dtype)
    meta = np.empty((0,) * (num_leading + len(shape)), dtype)
    blocks = np.empty([len(lengths) for lengths in chunks], object)
    is_whole = blocks.size == 1
    for place in itertools.product(*map(range, blocks.shape)):
        lengths = tuple(chunks[d][k] for d, k in enumerate(place))
        begins = tuple(sum(chunks[d][:k]) for d, k in enumerate(place))
        part = weights
        if not is_whole:
            # The rows of a block are taken when it is computed, once for all of its leading axes.
            part = delayed(_rows, pure=False)(weights, shape, begins, lengths)
        blocks[place] = array.map_blocks(
            _applied,
            values,
            weights=part,
            apply=apply,
            shape=lengths,
            num_source_dims=num_source_dims,
            dtype=dtype,
            meta=meta,
            chunks=(*leading, *((length,) for length in lengths)),
            drop_axis=list(range(num_leading, values.ndim)),
            new_axis=list(range(num_leading, num_leading + len(shape))),
        )
    return array.block(blocks.tolist())


def _applied(
    values: Any, weights: AnyWeights, apply: Any, shape: tuple[int, ...], num_source_dims: int
) -> Any:
    found = apply(values, weights)
    return found.reshape(*values.shape[: values.ndim - num_source_dims], *shape)


def _rows(
    weights: AnyWeights, shape: tuple[int, ...], begins: tuple[int, ...], lengths: tuple[int, ...]
) -> AnyWeights:
    """The weights of a block of targets."""
    axes = [np.arange(begin, begin + length) for begin, length in zip(begins, lengths, strict=True)]
    return weights._of_rows(np.ravel_multi_index(np.ix_(*axes), shape).reshape(-1))


def _chunks_of(
    wanted: OutputChunks,
    shape: tuple[int, ...],
    dims: tuple[Hashable, ...],
    leading_shape: tuple[int, ...],
    leading: tuple[tuple[int, ...], ...],
    dtype: Any,
) -> tuple[tuple[int, ...], ...]:
    """The lengths of blocks along each dimension of the targets. Those that are not given are as
    long as Dask's option `array.chunk-size` allows.
    """
    normalize_chunks: Any = import_module("dask.array.core").normalize_chunks
    if isinstance(wanted, Mapping):
        unknown = [str(name) for name in wanted if name not in dims]
        if unknown:
            raise ValueError(
                f"output_chunks has {', '.join(unknown)}, which are no dimensions of the targets: "
                f"{', '.join(map(str, dims))}"
            )
        wanted = tuple(wanted.get(name, "auto") for name in dims)
    elif wanted is None or isinstance(wanted, (int, str)):
        wanted = ("auto" if wanted is None else wanted,) * len(shape)
    elif len(wanted) != len(shape):
        raise ValueError(
            f"output_chunks has {len(wanted)} lengths for the {len(shape)} dimensions of the "
            "targets"
        )
    if math.prod(shape) * math.prod(leading_shape) == 0:
        return tuple((length,) for length in shape)
    found = normalize_chunks((*leading, *wanted), (*leading_shape, *shape), dtype=dtype)
    return tuple(found[len(leading) :])
