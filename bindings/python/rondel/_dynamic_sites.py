# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What triangulations whose sites come and go have in common."""

from __future__ import annotations

import operator

import numpy as np

from . import _core
from ._errors import InvalidInput
from ._repr import Described, count
from ._types import FloatArray, IntArray


def as_id(number: int, what: str = "site", position: int = 0) -> int:
    """An id as the library takes it; `position` is that of the argument."""
    number = operator.index(number)
    if not 0 <= number < 2**31:
        raise InvalidInput(f"{what} {number} does not exist", position)
    return number


class DynamicSites(Described):
    """Sites with ids, which they keep until they are removed.

    Attributes
    ----------
    _state : DynamicTriangulation or DynamicConstrainedTriangulation
        The triangulation of the library.

    """

    _state: _core.DynamicTriangulation | _core.DynamicConstrainedTriangulation

    def point(self, site: int) -> FloatArray:
        """Returns the coordinates of a site, an ndarray of float64, shape (3,)."""
        return np.array(self._state.site(as_id(site)))

    def representative(self, site: int) -> int:
        """Returns the lowest id in the place of a site, which represents all sites there."""
        return self._state.representative(as_id(site))

    @property
    def ids(self) -> IntArray:
        """Ndarray of int32: the ids of sites in use, increasing."""
        return self._state.site_ids()

    @property
    def dimension(self) -> int:
        """int: the dimension, as in `SphericalDelaunay`."""
        return self._state.dimension

    def __len__(self) -> int:
        return self._state.num_sites

    def __contains__(self, site: int) -> bool:
        site = operator.index(site)
        return 0 <= site < 2**31 and self._state.contains(site)

    def _size(self) -> tuple[str, str]:
        """The number of faces, or the dimension of what has none, for the text of an object."""
        if self.dimension == 2:
            return "faces", count(self._state.num_faces, "face")
        return "dimension", f"dimension {self.dimension}"
