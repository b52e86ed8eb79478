# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What bench/measure.h is for C++, for peers in Python: the same clock, repetition and memory."""

import ctypes
import json
import statistics
import time

ENOUGH_RUNS = 3
ENOUGH_SECONDS = 0.25
LONG_SECONDS = 8


def _peak_bytes():
    with open("/proc/self/status", encoding="ascii") as status:
        for line in status:
            if line.startswith("VmHWM:"):
                return 1024 * int(line.split()[1])
    raise OSError("no VmHWM in /proc/self/status")


def _reset_peak():
    with open("/proc/self/clear_refs", "w", encoding="ascii") as refs:
        refs.write("5")


def _keep_freed_memory():
    """mallopt(3): M_MMAP_MAX and M_TRIM_THRESHOLD."""
    c_library = ctypes.CDLL(None)
    c_library.mallopt(-4, 0)
    c_library.mallopt(-1, -1)


def measure(build):
    """(result, median seconds, seconds of the first run, growth of peak memory in it)."""
    result = None

    def run():
        nonlocal result
        result = None
        start = time.perf_counter()
        result = build()
        return time.perf_counter() - start

    _reset_peak()
    before = _peak_bytes()
    first = run()
    memory = _peak_bytes() - before
    _keep_freed_memory()
    run()
    seconds = []
    while sum(seconds) < ENOUGH_SECONDS or (len(seconds) < ENOUGH_RUNS
                                            and sum(seconds) < LONG_SECONDS):
        seconds.append(run())
    return result, statistics.median(seconds), first, memory


def print_build(sites, vertices, faces, seconds, first, memory):
    print(json.dumps({"sites": sites, "vertices": int(vertices), "faces": int(faces),
                      "seconds": seconds, "first_seconds": first,
                      "bytes_per_site": memory / sites}))
