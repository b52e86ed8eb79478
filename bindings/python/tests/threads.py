# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Ranks that are threads of one process."""

import threading

import numpy as np


class Rank:
    """One of some threads. What `on_call` raises, called in each call, ends the waiting of all."""

    def __init__(self, rank, boxes, barrier):
        self.rank = rank
        self.size = len(boxes)
        self.on_call = lambda: None
        self._boxes = boxes
        self._barrier = barrier

    def allgather(self, message):
        return self._meet([message] * self.size)

    def alltoall(self, messages):
        return self._meet(messages)

    def _meet(self, messages):
        try:
            assert len(messages) == self.size
            assert all(type(message) is bytes for message in messages)
            self.on_call()
        except BaseException:
            self._barrier.abort()
            raise
        self._boxes[self.rank] = messages
        self._barrier.wait(60)
        received = [each[self.rank] for each in self._boxes]
        self._barrier.wait(60)
        return received


def on_ranks(size, work):
    """What ``work(rank)`` returned or raised, by rank. That of rank 0 runs in this thread."""
    boxes, barrier = [None] * size, threading.Barrier(size)
    results = [None] * size

    def run(r):
        try:
            results[r] = work(Rank(r, boxes, barrier))
        except BaseException as error:
            results[r] = error

    threads = [threading.Thread(target=run, args=[r]) for r in range(1, size)]
    for thread in threads:
        thread.start()
    run(0)
    for thread in threads:
        thread.join()
    return results


def shares(points, size, seed=0):
    """The points of each rank, which may be none."""
    cuts = np.sort(np.random.default_rng(seed).integers(0, len(points) + 1, size - 1))
    return np.split(points, cuts)
