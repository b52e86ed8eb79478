# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""How objects describe themselves, as a line and as a table of HTML."""

from __future__ import annotations

import html


def count(number: int, singular: str, plural: str | None = None) -> str:
    """'1 face', '2 faces', '1,996 faces'."""
    return f"{number:,} {singular if number == 1 else plural or singular + 's'}"


class Described:
    """Objects whose `_facts()` are pairs of a name and a text."""

    def _facts(self) -> list[tuple[str, str]]:
        raise NotImplementedError

    def _summary(self) -> str:
        return ", ".join(text for _, text in self._facts())

    def __repr__(self) -> str:
        return f"<rondel.{type(self).__name__}: {self._summary()}>"

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><th style='text-align:left'>{html.escape(name)}</th>"
            f"<td style='text-align:left'>{html.escape(text)}</td></tr>"
            for name, text in self._facts()
        )
        return f"<table><caption>rondel.{type(self).__name__}</caption>{rows}</table>"
