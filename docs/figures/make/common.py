# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What the figures of Matplotlib have in common."""

import pathlib
import subprocess

import matplotlib

matplotlib.use("agg")
ROOT = pathlib.Path(__file__).resolve().parents[3]


def save(figure, name):
    """Writes docs/figures/NAME, reduced to 256 colors."""
    path = ROOT / "docs/figures" / name
    figure.savefig(path)
    subprocess.run(["pngquant", "--force", "--nofs", "--speed", "1", "--strip", "256", "--output", path, path], check=True)
