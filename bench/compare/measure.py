# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What bench/measure.h is for C++, for peers in Python: the same clock, repetition and memory."""

import json
import statistics
import time

ENOUGH_SECONDS = 0.05


def _peak_bytes():
    with open("/proc/self/status", encoding="ascii") as status:
        for line in status:
            if line.startswith("VmHWM:"):
                return 1024 * int(line.split()[1])
    raise OSError("no VmHWM in /proc/self/status")


def _reset_peak():
    with open("/proc/self/clear_refs", "w", encoding="ascii") as refs:
        refs.write("5")


def measure(build):
    """(result of the last run, median seconds, growth of peak memory in the first run)."""
    _reset_peak()
    before = _peak_bytes()
    seconds = []
    result = None
    while sum(seconds) < ENOUGH_SECONDS:
        result = None
        start = time.perf_counter()
        result = build()
        seconds.append(time.perf_counter() - start)
        if len(seconds) == 1:
            memory = _peak_bytes() - before
    return result, statistics.median(seconds), memory


def print_build(sites, vertices, faces, seconds, memory):
    print(json.dumps({"sites": sites, "vertices": int(vertices), "faces": int(faces),
                      "seconds": seconds, "bytes_per_site": memory / sites}))
