# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Attributes by UGRID 1.0, of Datasets and of groups of Zarr arrays."""

from __future__ import annotations

from typing import Any

from . import _core

MAKER = "made by rondel "


def about(title: str) -> dict[str, Any]:
    """The attributes of a file."""
    return {
        "Conventions": "CF-1.11 UGRID-1.0",
        "title": f"{title} on the sphere",
        "history": MAKER + _core.version,
    }


def topology(face_nodes: str) -> dict[str, Any]:
    """The attributes of the variable `mesh`, where `face_nodes` has the corners of faces."""
    return {
        "cf_role": "mesh_topology",
        "long_name": "topology of the mesh",
        "topology_dimension": 2,
        "node_coordinates": "node_lon node_lat",
        "face_node_connectivity": face_nodes,
        "face_dimension": "n_face",
    }


def connectivity(role: str, name: str) -> dict[str, Any]:
    return {"cf_role": f"{role}_connectivity", "long_name": name, "start_index": 0}


CORNERS = connectivity("face_node", "corners of the faces, counterclockwise")
ACROSS = connectivity("face_face", "faces opposite to each corner")


def values_at(what: str, name: str = "") -> dict[str, Any]:
    """Attributes of values at the nodes or the faces."""
    place = {"mesh": "mesh", "location": what, "coordinates": f"{what}_lon {what}_lat"}
    return {"long_name": name, **place} if name else place


def angles(what: str) -> dict[str, dict[str, Any]]:
    """The names and attributes of the longitudes and latitudes of the nodes or the faces."""
    return {
        f"{what}_{name}": {"standard_name": full, "long_name": f"{full} of {what}s", "units": units}
        for name, full, units in (
            ("lon", "longitude", "degrees_east"),
            ("lat", "latitude", "degrees_north"),
        )
    }
