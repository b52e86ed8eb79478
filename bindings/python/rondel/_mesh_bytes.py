# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The mesh of a Dataset as the bytes of a netCDF file, which the readers of meshes take.

The format is CDF-5, of netCDF's classic ones that with integers of all sizes
(https://docs.unidata.ucar.edu/nug/current/file_format_specifications.html).
"""

from __future__ import annotations

import struct
from typing import Any

import numpy as np

from ._coordinates import parts_of_grids

# The numbers of the types, and the tags of lists.
_TYPES = {
    "i1": 1,
    "i2": 3,
    "i4": 4,
    "f4": 5,
    "f8": 6,
    "u1": 7,
    "u2": 8,
    "u4": 9,
    "i8": 10,
    "u8": 11,
}
_TEXT = 2
_DIMENSIONS, _VARIABLES, _ATTRIBUTES = 10, 11, 12


def mesh_bytes(data: Any, *places: str, attributes: dict[str, str] | None = None) -> bytes:
    """The variables of a Dataset that describe its mesh, and those of the longitudes and latitudes
    that are given; of several topologies of UGRID that whose places these are, or else the first
    one. The file gets the attributes.
    """
    parts = parts_of_grids(data) | {*places}
    topologies = [name for name in data.variables if _is_topology(data[name])]
    parts -= {str(name) for name in topologies}
    if topologies:
        topology = next((t for t in topologies if {*places} <= _words(data[t])), topologies[0])
        parts.add(str(topology))
    variables = {str(name): data.variables[name] for name in data.variables if str(name) in parts}
    kept = {name: item for name, item in variables.items() if _can_be_written(item)}
    return _file(kept, attributes or {})


def _is_topology(variable: Any) -> bool:
    known = _meaning(variable)
    role = known.get("cf_role", known.get("standard_name"))
    return bool(role == "mesh_topology")


def _words(variable: Any) -> set[str]:
    texts = (text for text in _meaning(variable).values() if isinstance(text, str))
    return {word for text in texts for word in text.split()}


def _meaning(variable: Any) -> dict[Any, Any]:
    """The attributes, with the texts that xarray has moved to `encoding`, as node_coordinates."""
    moved = {
        key: text
        for key, text in variable.encoding.items()
        if isinstance(text, str) and key != "_Unsigned"
    }
    return {**moved, **variable.attrs}


def _can_be_written(variable: Any) -> bool:
    return variable.ndim == 0 or (variable.dtype.kind in "biuf" and variable.size > 0)


def _padded(content: bytes) -> bytes:
    return content + bytes(-len(content) % 4)


def _name(text: str) -> bytes:
    encoded = text.encode()
    return struct.pack(">q", len(encoded)) + _padded(encoded)


def _list(tag: int, items: list[bytes]) -> bytes:
    return struct.pack(">iq", tag if items else 0, len(items)) + b"".join(items)


def _attributes(attributes: dict[Any, Any]) -> bytes:
    """Texts and numbers; attributes of other kinds say nothing of a mesh."""
    items = []
    for name, value in attributes.items():
        if isinstance(value, str):
            encoded = value.encode()
            kind, count = _TEXT, len(encoded)
        else:
            numbers = np.atleast_1d(np.asarray(value))
            if numbers.dtype.kind not in "biuf":
                continue
            kind, count = _TYPES["f8"], numbers.size
            encoded = numbers.astype(">f8").tobytes()
        items.append(_name(str(name)) + struct.pack(">iq", kind, count) + _padded(encoded))
    return _list(_ATTRIBUTES, items)


def _numbers(variable: Any) -> Any:
    """The values as the file has them; a variable without dimensions has its attributes alone."""
    if variable.dtype.kind not in "biuf":
        return np.zeros((), np.int32)
    values = np.asarray(variable.values)
    if values.dtype.kind == "b":
        return values.astype(np.uint8)
    known = values.dtype.newbyteorder("=").str[1:] in _TYPES
    return values if known else values.astype(np.float64)


def _file(variables: dict[str, Any], attributes: dict[str, str]) -> bytes:
    sizes = {str(dim): size for item in variables.values() for dim, size in item.sizes.items()}
    numbers = {dim: k for k, dim in enumerate(sizes)}
    dimensions = [_name(dim) + struct.pack(">q", size) for dim, size in sizes.items()]
    start = b"CDF\x05" + struct.pack(">q", 0) + _list(_DIMENSIONS, dimensions)
    start += _attributes(attributes)
    heads, contents = [], []
    for name, item in variables.items():
        values = _numbers(item)
        kind = _TYPES[values.dtype.newbyteorder("=").str[1:]]
        dims = [numbers[str(dim)] for dim in item.dims]
        contents.append(_padded(values.astype(values.dtype.newbyteorder(">")).tobytes()))
        head = _name(name) + struct.pack(f">q{len(dims)}q", len(dims), *dims)
        heads.append(
            head + _attributes(_meaning(item)) + struct.pack(">iq", kind, len(contents[-1]))
        )
    place = len(start) + len(_list(_VARIABLES, heads)) + 8 * len(heads)
    placed = []
    for head, content in zip(heads, contents, strict=True):
        placed.append(head + struct.pack(">q", place))
        place += len(content)
    return start + _list(_VARIABLES, placed) + b"".join(contents)
