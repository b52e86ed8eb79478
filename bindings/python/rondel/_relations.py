# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""How geometries lie to each other, with the names of shapely."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from . import _core
from ._arrays import as_threads
from ._geometries import Edges, Invalid
from ._operands import have_lines, in_words_of, operands, paired


def relate(
    a: Any,
    b: Any,
    *,
    edges: Edges = "lonlat",
    invalid: Invalid = "error",
    align: bool = True,
    threads: int | None = None,
) -> Any:
    """Computes how geometries lie to each other, pair by pair: the exact DE-9IM on the sphere.

    Parameters
    ----------
    a, b, edges, invalid, align, threads
        As in `intersection`.

    Returns
    -------
    str, ndarray of str or pandas.Series
        The matrix of the dimensionally extended nine-intersection model in one row, "212101212":
        the dimensions of what the interior, the boundary and the exterior of `a` have in common
        with those of `b`, 'F' for nothing. None if a geometry is missing. It is a Series with the
        common index if two GeoSeries or GeoDataFrames are paired by their indices.

    Raises
    ------
    ValueError, TypeError
        As `intersection`.

    See Also
    --------
    relate_pattern, intersects, contains, within, covers, covered_by, touches, crosses, overlaps,
    equals

    Notes
    -----
    Nothing is rounded: the relation is that of the arcs between the corners as doubles
    (docs/theory/arrangements.md, "Relations"). Positions of both arguments are read together, so
    sides that are the same in longitude and latitude have the same corners, and a point on a side
    is on it. A geometry consists of points, lines or polygons, and not of several of these. For the
    model see Clementini, Di Felice and van Oosterom (1993).

    Examples
    --------
    >>> import rondel, shapely
    >>> fiji, date_line = shapely.box(177, -19, 181, -16), shapely.box(179, -25, 185, 0)
    >>> rondel.relate(fiji, date_line)
    '212101212'
    >>> rondel.relate([fiji, date_line], shapely.box(-179, -19, -178, -16)).tolist()
    ['FF2F11212', '212FF1FF2']

    """
    return _asked(a, b, edges, invalid, align, threads, lambda relations: relations.texts(), None)


def relate_pattern(
    a: Any,
    b: Any,
    pattern: str,
    *,
    edges: Edges = "lonlat",
    invalid: Invalid = "error",
    align: bool = True,
    threads: int | None = None,
) -> Any:
    """Finds out whether the relations of geometries fit to a pattern, pair by pair.

    Parameters
    ----------
    a, b
        As in `intersection`.
    pattern : str
        Nine characters: T (not F), F, 0, 1, 2, or * (anything).
    edges, invalid, align, threads
        As in `intersection`.

    Returns
    -------
    bool, ndarray of bool or pandas.Series
        As of `intersects`.

    Raises
    ------
    ValueError, TypeError
        As `intersection`, or if the pattern is none.

    Examples
    --------
    >>> import rondel, shapely
    >>> left, right = shapely.box(0, 0, 1, 1), shapely.box(1, 0, 2, 1)
    >>> bool(rondel.relate_pattern(left, right, "F***1****"))
    True

    """
    return _asked(
        a, b, edges, invalid, align, threads, lambda relations: relations.match(pattern), False
    )


def intersects(
    a: Any,
    b: Any,
    *,
    edges: Edges = "lonlat",
    invalid: Invalid = "error",
    align: bool = True,
    threads: int | None = None,
) -> Any:
    """Finds out whether geometries have a place in common, pair by pair.

    Parameters
    ----------
    a, b, edges, invalid, align, threads
        As in `intersection`.

    Returns
    -------
    bool, ndarray of bool or pandas.Series
        One answer for each pair, False if a geometry is missing. It is a Series with the common
        index if two GeoSeries or GeoDataFrames are paired by their indices.

    Raises
    ------
    ValueError, TypeError
        As `intersection`.

    Notes
    -----
    The answer is exact, as of `relate`. Places of the border belong to a polygon, and its ends to a
    line.

    Examples
    --------
    >>> import rondel, shapely
    >>> boxes = [shapely.box(179, 0, 181, 1), shapely.box(0, 0, 1, 1)]
    >>> rondel.intersects(boxes, shapely.box(-180, 0, -179.5, 1)).tolist()
    [True, False]

    """
    return _are(a, b, "intersects", edges, invalid, align, threads)


def _predicate(name: str, what: str, example: str) -> Any:
    def asked(
        a: Any,
        b: Any,
        *,
        edges: Edges = "lonlat",
        invalid: Invalid = "error",
        align: bool = True,
        threads: int | None = None,
    ) -> Any:
        return _are(a, b, name, edges, invalid, align, threads)

    asked.__name__ = asked.__qualname__ = name
    asked.__doc__ = f"""Finds out whether {what}, pair by pair.

    Parameters
    ----------
    a, b, edges, invalid, align, threads
        As in `intersection`.

    Returns
    -------
    bool, ndarray of bool or pandas.Series
        As of `intersects`.

    Raises
    ------
    ValueError, TypeError
        As `intersection`.

    Examples
    --------
    >>> import rondel, shapely
    >>> bool({example})
    True

    """
    return asked


disjoint = _predicate(
    "disjoint",
    "geometries have no place in common",
    "rondel.disjoint(shapely.box(0, 0, 1, 1), shapely.box(2, 0, 3, 1))",
)
contains = _predicate(
    "contains",
    "all of `b` is in `a`, and their interiors meet",
    "rondel.contains(shapely.box(-180, 60, 180, 90), shapely.box(170, 70, 190, 80))",
)
within = _predicate(
    "within",
    "all of `a` is in `b`, and their interiors meet",
    "rondel.within(shapely.Point(175, 70), shapely.box(-180, 60, 180, 90))",
)
covers = _predicate(
    "covers",
    "all of `b` is in `a` or on its border; for polygons the same as `contains`",
    "rondel.covers(shapely.box(0, 0, 2, 2), shapely.Point(2, 1))",
)
covered_by = _predicate(
    "covered_by",
    "all of `a` is in `b` or on its border; for polygons the same as `within`",
    "rondel.covered_by(shapely.Point(2, 1), shapely.box(0, 0, 2, 2))",
)
touches = _predicate(
    "touches",
    "geometries meet, but not their interiors",
    "rondel.touches(shapely.box(0, 0, 1, 1), shapely.box(1, 0, 2, 1))",
)
overlaps = _predicate(
    "overlaps",
    "geometries of one kind share a part of their interiors, and each has one of its own",
    "rondel.overlaps(shapely.box(0, 0, 2, 1), shapely.box(1, 0, 3, 1))",
)
crosses = _predicate(
    "crosses",
    "two lines cross, or a line or points are in part inside and in part outside",
    "rondel.crosses(shapely.LineString([(-5, 1), (5, 1)]), shapely.box(0, 0, 9, 9))",
)
equals = _predicate(
    "equals",
    "geometries have the same places, or both are empty",
    "rondel.equals(shapely.box(170, 0, 190, 1), shapely.box(-190, 0, -170, 1))",
)


def _are(
    a: Any, b: Any, name: str, edges: Edges, invalid: Invalid, align: bool, threads: int | None
) -> Any:
    return _asked(
        a, b, edges, invalid, align, threads, lambda relations: relations.are(name), False
    )


def _asked(
    a: Any,
    b: Any,
    edges: Edges,
    invalid: Invalid,
    align: bool,
    threads: int | None,
    question: Callable[[_core.RelationsOfPairs], Any],
    unknown: str | bool | None,
) -> Any:
    """The answers to a question about each pair; `unknown` if a geometry is missing."""
    first, second = operands({"a": a, "b": b}, edges, threads, invalid)
    pairs = paired(first, second, align)
    both: tuple[Any, Any] = (first.cells, second.cells)
    if have_lines(first, second):
        both = (first.all_geometries(), second.all_geometries())
    try:
        found = _core.relations(*both, pairs.cells, as_threads(threads))
    except ValueError as error:
        raise ValueError(in_words_of((first, second), str(error))) from None
    answers = np.full(pairs.num_rows, unknown, object if unknown is None else bool)
    answers[pairs.rows] = question(found)
    if pairs.index is None:
        return answers.reshape(pairs.shape)[()]
    import pandas

    return pandas.Series(answers, index=pairs.index)
