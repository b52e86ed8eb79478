# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The notebooks of docs/notebooks: their cells run, one after the other, and draw pictures."""

import pathlib
import re
import time

import pytest

plt = pytest.importorskip("matplotlib.pyplot")

FOLDER = pathlib.Path(__file__).resolve().parents[3] / "docs/notebooks"
NOTEBOOKS = sorted(path.stem for path in FOLDER.glob("*.md") if path.stem != "README")
CELL = re.compile(r"^```\{code-cell\} ipython3\n(.*?)^```$", re.M | re.S)
LONGEST = 60  # seconds, on a machine that does other things beside


def test_the_notebooks_are_those_of_the_index():
    index = (FOLDER / "README.md").read_text("utf-8")
    assert sorted(set(re.findall(r"\]\((\w+)\.md\)", index))) == NOTEBOOKS
    assert len(NOTEBOOKS) == 5


@pytest.mark.parametrize("name", NOTEBOOKS)
def test_a_notebook_runs_and_draws(name, tmp_path, monkeypatch):
    if name == "regridding":
        pytest.importorskip("xarray")
        pytest.importorskip("netCDF4")
    text = (FOLDER / f"{name}.md").read_text("utf-8")
    cells = CELL.findall(text)
    assert len(cells) == text.count("{code-cell}") >= 3
    monkeypatch.chdir(tmp_path)
    plt.close("all")
    names = {"__name__": "notebook"}
    start = time.monotonic()
    for cell in cells:
        exec(compile(cell, f"{name}.md", "exec"), names)
    assert time.monotonic() - start < LONGEST
    axes = [plt.figure(number).axes[0] for number in plt.get_fignums()]
    try:
        assert len(axes) >= 2
        for ax in axes:
            ax.figure.canvas.draw()
            assert ax.collections, "a picture without anything in it"
    finally:
        plt.close("all")
