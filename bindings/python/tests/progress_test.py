# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Bars of long calls: what a terminal, a notebook and tqdm are given."""

import io
import re
import sys
import types

import clouds
import pytest

import rondel
import rondel._progress as module


@pytest.fixture
def clock(monkeypatch):
    """A clock that stands, and is set by hand."""
    now = types.SimpleNamespace(seconds=100.0)
    monkeypatch.setattr(module.time, "monotonic", lambda: now.seconds)
    return now


def last(text):
    return text.split("\r\x1b[K")[-1]


def test_a_line_names_the_stage_its_share_and_the_time_left(clock):
    out = io.StringIO()
    with rondel.ProgressBar(file=out) as bar:
        bar("order", 0.5)
        assert out.getvalue() == ""  # short calls show nothing
        clock.seconds += 2
        bar("faces", 0.0)
        assert last(out.getvalue()) == f"[{'.' * 24}] faces 0 %"
        clock.seconds += 4
        bar("faces", 0.25)
        assert last(out.getvalue()) == f"[{'#' * 6}{'.' * 18}] faces 25 %, 13 s left"
        clock.seconds += 0.01
        bar("faces", 0.5)  # not more often than ten times a second
        assert last(out.getvalue()).startswith(f"[{'#' * 6}.")
    assert out.getvalue().endswith("\r\x1b[K")
    assert "\n" not in out.getvalue()


@pytest.mark.parametrize(
    ("seconds", "fraction", "said"),
    [
        (0.5, 0.5, ""),
        (100, 0.001, ""),
        (100, 1.0, ""),
        (10, 0.5, ", 11 s left"),
        (100, 0.5, ", 1 min 41 s left"),
        (5000, 0.5, ", 1 h 23 min left"),
        (1e9, 0.5, ", 100 h 00 min left"),
    ],
)
def test_the_time_left_is_said_as_people_say_it(seconds, fraction, said):
    assert module._time_left(seconds, fraction) == said


def test_files_and_short_calls_show_nothing(clock, capsys):
    with rondel.ProgressBar() as bar:
        clock.seconds += 10
        bar("order", 0.5)  # standard error is no terminal here
    assert capsys.readouterr().err == ""


def test_bars_of_tqdm_are_made_for_each_stage_and_closed():
    made = []

    class Bar:
        def __init__(self, total, desc):
            self.total, self.desc, self.done, self.is_closed = total, desc, 0, False
            made.append(self)

        def update(self, steps):
            assert steps > 0
            self.done += steps

        def close(self):
            self.is_closed = True

    with rondel.ProgressBar(Bar) as bar:
        for stage, fraction in [("a", 0), ("a", 0.5), ("a", 0.5), ("a", 1), ("b", 0.25)]:
            bar(stage, fraction)
    assert [(each.desc, each.total, each.done, each.is_closed) for each in made] == [
        ("a", 100, 100, True),
        ("b", 100, 25, True),
    ]


def test_a_notebook_has_one_bar_that_is_changed_and_removed(clock, monkeypatch):
    shown = []

    class Handle:
        def update(self, picture):
            shown.append(picture._repr_html_())

    def display(picture, display_id):
        assert display_id
        shown.append(picture._repr_html_())
        return Handle()

    ipython = types.ModuleType("IPython")
    ipython.get_ipython = lambda: types.SimpleNamespace(kernel=object())
    ipython.display = types.ModuleType("IPython.display")
    ipython.display.display = display
    monkeypatch.setitem(sys.modules, "IPython", ipython)
    monkeypatch.setitem(sys.modules, "IPython.display", ipython.display)
    with rondel.ProgressBar() as bar:
        bar("a < b", 0)
        clock.seconds += 2
        bar("a < b", 0.5)
        clock.seconds += 1
        bar("a < b", 0.75)
    assert len(shown) == 3
    assert 'value="0.500"' in shown[0]
    assert "a &lt; b 50 %, 3 s left" in shown[0]
    assert 'value="0.750"' in shown[1]
    assert shown[2] == ""


def test_calls_take_it():
    out = io.StringIO()
    with rondel.ProgressBar(file=out) as bar:
        bar._next = 0.0  # without the wait
        tri = rondel.delaunay(clouds.uniform(300_000), threads=1, progress=bar)
    assert len(tri.simplices) == 599_996
    assert re.search(r"\[[#.]{24}\] \w+ \d+ %", out.getvalue())
    assert out.getvalue().endswith("\r\x1b[K")


@pytest.fixture
def bars(monkeypatch):
    """The bars that are made, whose lines go into a text."""
    made = []

    class Bar(rondel.ProgressBar):
        def __init__(self):
            super().__init__(file=io.StringIO())
            self._next = 0.0  # without the wait
            made.append(self)

    monkeypatch.setattr(rondel, "ProgressBar", Bar)
    monkeypatch.setattr(module, "ProgressBar", Bar)
    return made


def test_true_makes_a_bar_for_the_call(bars):
    rondel.delaunay(clouds.uniform(300_000), threads=1, progress=True)
    (bar,) = bars
    assert re.search(r"\[[#.]{24}\] \w+ \d+ %", bar._file.getvalue())
    assert bar._file.getvalue().endswith("\r\x1b[K")


def test_true_removes_the_bar_of_a_call_that_fails(bars, monkeypatch):
    show = rondel.ProgressBar.__call__

    def stop(self, stage, fraction):
        show(self, stage, fraction)
        raise KeyError(stage)

    monkeypatch.setattr(rondel.ProgressBar, "__call__", stop)
    with pytest.raises(KeyError):
        rondel.delaunay(clouds.uniform(300_000), threads=1, progress=True)
    assert bars[0]._file.getvalue().endswith("\r\x1b[K")


def test_false_is_none(bars):
    points = clouds.uniform(300)
    tri = rondel.delaunay(points, progress=False)
    assert (tri.simplices == rondel.delaunay(points).simplices).all()
    assert not bars
