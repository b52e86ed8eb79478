# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Area weights of anemoi-graphs, computed by Rondel on the sphere.

The classes take the place of anemoi-graphs' own in a configuration:

    attributes:
      area_weight:
        _target_: anemoi_graphs.RegionalAreaWeights     # this file, in a folder of PYTHONPATH
        norm: unit-max

Run as a program, it prints the weights of a small regional domain.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import rondel
import torch
from anemoi.graphs.nodes.attributes import MaskedPlanarAreaWeights, SphericalAreaWeights
from torch_geometric.data import HeteroData

# Nodes are often float32, for which a pole is up to this many degrees beyond 90.
ROUNDING_DEG = 1e-5


def areas_of(latlons: np.ndarray, edge: Any) -> np.ndarray:
    """The areas of nodes in steradians.

    Parameters
    ----------
    latlons : ndarray, shape (n, 2)
        Latitudes and longitudes in radians, as anemoi-graphs has them.
    edge
        As in `rondel.area_weights`.

    Returns
    -------
    ndarray of float64, shape (n,)
        The areas. Nodes in the same place share their cell, so that no area is 0.

    """
    lat, lon = np.degrees(latlons.astype(np.float64)).T
    is_pole = (np.abs(lat) > 90) & (np.abs(lat) <= 90 + ROUNDING_DEG)
    return rondel.area_weights(np.where(is_pole, np.copysign(90, lat), lat), lon, edge=edge)


class AreaWeights(SphericalAreaWeights):
    """In place of `SphericalAreaWeights`, for nodes all over the globe.

    The diagram is exact, also for coordinates of single precision, stretched grids, nodes in the
    same place and nodes on one circle.

    Parameters
    ----------
    edge
        As in `rondel.area_weights`; by default cells are not cut.
    norm, radius, dtype
        As in `SphericalAreaWeights`. Its `centre` and `fill_value` are accepted and change nothing:
        areas do not depend on the center, and no node lacks an area.

    """

    def __init__(self, *args: Any, edge: Any = "sphere", **options: Any) -> None:
        super().__init__(*args, **options)
        self.edge = edge

    def compute_area_weights(self, latlons: np.ndarray) -> np.ndarray:
        """The areas of the nodes on the sphere of the radius."""
        return areas_of(latlons, self.edge) * self.radius**2


class RegionalAreaWeights(AreaWeights):
    """In place of `PlanarAreaWeights`, for the nodes of regional domains of any shape.

    Areas are those on the sphere, not in the plane of longitudes and latitudes, so that a node at
    60 degrees weighs half as much as one at the equator that has as many degrees. Cells at borders
    are cut as `edge="mirror"` of `rondel.area_weights` says, where `PlanarAreaWeights` takes the
    area of the nearest cell inside.
    """

    def __init__(self, *args: Any, edge: Any = "mirror", **options: Any) -> None:
        super().__init__(*args, edge=edge, **options)


class MaskedRegionalAreaWeights(MaskedPlanarAreaWeights):
    """In place of `MaskedPlanarAreaWeights`: the masked nodes by themselves, and 0 elsewhere.

    Parameters
    ----------
    edge
        As in `rondel.area_weights`; by default 'mirror'.
    mask_node_attr_name, norm, dtype
        As in `MaskedPlanarAreaWeights`.

    """

    def __init__(self, *args: Any, edge: Any = "mirror", **options: Any) -> None:
        super().__init__(*args, **options)
        self.edge = edge

    def compute_area_weights(self, latlons: np.ndarray) -> np.ndarray:
        """The areas of the nodes on the unit sphere."""
        return areas_of(latlons, self.edge)


def main() -> None:
    """Prints the weights of a domain of 40 by 60 nodes, a quarter of a degree apart."""
    lat, lon = np.meshgrid(np.arange(50, 60, 0.25), np.arange(0, 15, 0.25), indexing="ij")
    graph = HeteroData()
    graph["data"].x = torch.tensor(np.radians(np.stack([lat.ravel(), lon.ravel()], axis=1)))
    for builder in (AreaWeights(norm="unit-max"), RegionalAreaWeights(norm="unit-max")):
        weights = builder.compute(graph, "data").reshape(lat.shape)
        corner, middle = float(weights[0, 0]), float(weights[20, 30])
        print(f"{type(builder).__name__}: corner {corner:.4f}, middle {middle:.4f}")


if __name__ == "__main__":
    main()
