# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The examples of the documents do what is printed there."""

import doctest
import importlib.util
import pathlib
import pkgutil
import re
import sys

import numpy as np
import pytest

import rondel

ROOT = pathlib.Path(__file__).resolve().parents[3]
OPTIONS = doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS


@pytest.fixture(autouse=True)
def _at_the_root(monkeypatch):
    monkeypatch.chdir(ROOT)


def modules():
    return sorted(module.name for module in pkgutil.iter_modules(rondel.__path__, "rondel."))


@pytest.fixture(autouse=True)
def _without_scalars_of_numpy(monkeypatch):
    """Refuses what NumPy 1 and 2 print differently: numbers and booleans of NumPy."""
    shown = sys.__displayhook__

    def show(value):
        parts = value if isinstance(value, (tuple, list, set)) else [value]
        for part in parts:
            if isinstance(part, (np.bool_, np.number)):
                raise AssertionError(f"NumPy 1 and 2 print {part} differently: {type(part)}")
        shown(value)

    monkeypatch.setattr(sys, "__displayhook__", show)


@pytest.mark.parametrize("name", modules())
def test_docstrings(name):
    if name in ("rondel.xarray", "rondel._coordinates", "rondel._places"):
        pytest.importorskip("xarray")
    if name != "rondel._core":
        # Without the module's own names: an example imports what it uses.
        module = __import__(name, fromlist=["_"])
        failed, _ = doctest.testmod(module, globs={}, optionflags=OPTIONS)
        assert failed == 0


def documents():
    """The documents that show what Python answers."""
    paths = [ROOT / "README.md", *ROOT.glob("docs/**/*.md"), *ROOT.glob("bindings/**/*.md")]
    return sorted(
        str(p.relative_to(ROOT)) for p in paths if "\n```python\n>>> " in p.read_text("utf-8")
    )


@pytest.mark.parametrize("document", documents())
def test_documents(document):
    blocks = re.findall(
        r"^```python\n(.*?)^```$", (ROOT / document).read_text("utf-8"), re.M | re.S
    )
    assert blocks
    for package in ("xarray", "geopandas"):
        if importlib.util.find_spec(package) is None:
            blocks = [block for block in blocks if f"import {package}" not in block]
    examples = doctest.DocTestParser().get_doctest("".join(blocks), {}, document, document, 0)
    assert examples.examples
    said = []
    failed, _ = doctest.DocTestRunner(optionflags=OPTIONS).run(examples, out=said.append)
    assert failed == 0, "".join(said)


def test_the_list_of_deviations_is_in_the_guide():
    from scipy_suite_test import DEVIATIONS

    guide = (ROOT / "docs/guide/python.md").read_text("utf-8")
    for pattern in DEVIATIONS:
        assert re.match(r"\w+", pattern).group() in guide
