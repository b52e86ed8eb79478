# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Pickles of objects of the C++ library, as the arrays that they hold."""

from __future__ import annotations

from typing import Any, TypeVar

Held = TypeVar("Held")


def arrays_of(held: Any) -> dict[str, Any]:
    """All members of an object of the library that can be set, which say everything."""
    names = [
        name
        for name, member in vars(type(held)).items()
        if isinstance(member, property) and member.fset is not None
    ]
    return {name: getattr(held, name) for name in names}


def with_arrays(made: Held, arrays: dict[str, Any]) -> Held:
    """A new object of the library, which gets these members."""
    for name, values in arrays.items():
        setattr(made, name, values)
    return made
