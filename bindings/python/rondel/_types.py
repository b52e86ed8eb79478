# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Names of types, for annotations."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Literal, Protocol, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _core

if TYPE_CHECKING:
    import xarray

ArrayLike: TypeAlias = npt.ArrayLike
FloatArray: TypeAlias = npt.NDArray[np.float64]
IntArray: TypeAlias = npt.NDArray[np.int32]
BoolArray: TypeAlias = npt.NDArray[np.bool_]
Model: TypeAlias = Literal["projected", "weighted"]
Listener: TypeAlias = Callable[[str, float], Any]
Progress: TypeAlias = Listener | bool | None
Properties: TypeAlias = Mapping[str, Any]
Path: TypeAlias = str | bytes | os.PathLike[str] | os.PathLike[bytes]


class Triangulated(Protocol):
    """What functions of other modules need of `SphericalDelaunay`, whose methods they are."""

    @property
    def points(self) -> FloatArray: ...
    @property
    def center(self) -> FloatArray: ...
    @property
    def lonlat(self) -> FloatArray: ...
    @property
    def simplices(self) -> IntArray: ...
    @property
    def neighbors(self) -> IntArray: ...
    @property
    def duplicates(self) -> IntArray: ...
    @property
    def ghost(self) -> BoolArray: ...
    @property
    def edges(self) -> IntArray: ...
    @property
    def vertices(self) -> IntArray: ...
    @property
    def _triangulation(self) -> _core.Triangulation: ...
    @property
    def _degrees(self) -> FloatArray | None: ...
    def to_xarray(self) -> xarray.Dataset: ...


class Divided(Protocol):
    """What functions of other modules need of diagrams, whose methods they are."""

    @property
    def points(self) -> FloatArray: ...
    @property
    def center(self) -> FloatArray: ...
    @property
    def radius(self) -> float: ...
    @property
    def delaunay(self) -> Any: ...
    @property
    def cells(self) -> tuple[npt.NDArray[np.int64], IntArray, FloatArray]: ...
    @property
    def ridge_vertices(self) -> IntArray: ...
    @property
    def _diagram(self) -> _core.Diagram: ...
    def to_xarray(self, *, properties: Properties | None = None) -> xarray.Dataset: ...
