# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Long work lets others run, says how far it is, and ends when it is asked to."""

import json
import signal
import threading
import time

import clouds
import numpy as np
import pytest

import rondel
from rondel import _geo

MANY = clouds.uniform(1 << 18)


@pytest.fixture
def alarm():
    """Calls a function, and raises KeyboardInterrupt in the main thread after a time, as Ctrl-C
    does.
    """

    def call(seconds, function, *arguments, **options):
        signal.setitimer(signal.ITIMER_REAL, seconds)
        return function(*arguments, **options)

    before = signal.signal(signal.SIGALRM, signal.default_int_handler)
    yield call
    signal.setitimer(signal.ITIMER_REAL, 0)
    signal.signal(signal.SIGALRM, before)


@pytest.mark.parametrize("make", [rondel.delaunay, rondel.SphericalVoronoi])
def test_an_interrupt_ends_the_work(alarm, make):
    with pytest.raises(KeyboardInterrupt):
        alarm(0.01, make, MANY, threads=1)


@pytest.mark.parametrize(
    "ask",
    [
        lambda tri: tri.voronoi().areas,
        lambda tri: tri.within(MANY, 0.01),
        lambda tri: tri.validate(),
    ],
    ids=["areas", "within", "validate"],
)
def test_an_interrupt_ends_questions_too(alarm, ask):
    tri = rondel.delaunay(MANY)
    with pytest.raises(KeyboardInterrupt):
        alarm(0.002, ask, tri)


def test_an_interrupt_ends_the_writing_of_files(alarm, tmp_path):
    tri = rondel.delaunay(MANY)
    diagram = tri.voronoi()
    assert diagram.areas.size
    path = tmp_path / "out.geojson"
    for write in (diagram.to_geojson, tri.to_geojson):
        with pytest.raises(KeyboardInterrupt):
            alarm(0.05, write, path)
        assert not path.exists()


def test_an_interrupt_ends_the_reading_of_what_was_written(alarm):
    text = json.dumps({"features": [{"type": "Feature", "n": n} for n in range(1 << 19)]})

    def write(_):
        return alarm(0.01, text.encode)

    with pytest.raises(KeyboardInterrupt):
        _geo.written(None, write)


def test_an_interrupt_ends_the_work_early(alarm):
    """In time of processors: the machine may have other work, too."""
    tri = rondel.delaunay(MANY)
    tri.nearest(MANY[:1])
    begin = time.process_time()
    tri.k_nearest(MANY, 8)
    whole = time.process_time() - begin
    begin = time.process_time()
    with pytest.raises(KeyboardInterrupt):
        alarm(0.01, tri.k_nearest, MANY, 8)
    assert time.process_time() - begin < whole


def test_progress_is_told():
    told = []
    rondel.delaunay(MANY, threads=1, progress=lambda *what: told.append(what))
    assert told
    assert {stage for stage, _ in told} <= {"order", "triangulate"}
    fractions = [fraction for _, fraction in told]
    assert all(0 <= fraction <= 1 for fraction in fractions)
    assert told[-1] == ("triangulate", 1)


def test_what_a_listener_raises_ends_the_work():
    def stop(stage, fraction):
        raise RuntimeError(f"enough of {stage}")

    with pytest.raises(RuntimeError, match="enough of"):
        rondel.delaunay(MANY, progress=stop)
    with pytest.raises(TypeError):
        rondel.delaunay(MANY, progress=lambda: None)


def test_errors_come_through_from_the_other_thread():
    points = MANY.copy()
    points[100_000, 2] = np.nan
    with pytest.raises(rondel.InvalidInput) as caught:
        rondel.delaunay(points)
    assert caught.value.index == 100_000


def test_other_threads_run_meanwhile():
    ticks = []
    done = threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    begin = time.perf_counter()
    rondel.delaunay(MANY, threads=1)
    end = time.perf_counter()
    done.set()
    thread.join()
    assert sum(begin < at < end for at in ticks) >= 5
