# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Tables as Markdown and CSV."""

import csv
import dataclasses


@dataclasses.dataclass
class Table:
    """`rows` are lists of cells; `notes` are lines below the table."""

    title: str
    head: list
    rows: list
    notes: list = dataclasses.field(default_factory=list)

    def markdown(self):
        lines = [f"### {self.title}", "", _line(self.head), _line(["---"] * len(self.head)),
                 *(_line(row) for row in self.rows)]
        for note in self.notes:
            lines += ["", note]
        return "\n".join(lines) + "\n"

    def write_csv(self, path):
        with open(path, "w", newline="", encoding="utf-8") as file:
            csv.writer(file).writerows([self.head, *self.rows])


def _line(cells):
    return "| " + " | ".join(str(cell).replace("|", "\\|") for cell in cells) + " |"


def number(value):
    """Three digits that matter, thousands apart: 1,234  56.7  0.891."""
    if value >= 100:
        return f"{value:,.0f}"
    return f"{value:.1f}" if value >= 10 else f"{value:.2f}"


def power(n):
    """2^20 for such numbers, otherwise the number."""
    return f"2^{n.bit_length() - 1}" if n & (n - 1) == 0 else f"{n:,}"


def spread(values):
    """Of (median, least, greatest): "430 (387 to 461)"."""
    middle, least, greatest = map(number, values)
    return middle if least == greatest else f"{middle} ({least} to {greatest})"
