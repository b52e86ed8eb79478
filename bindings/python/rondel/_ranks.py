# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The ranks of a communicator, as the C++ library calls them."""

from __future__ import annotations

import contextlib
import json
import os
import platform
import sys
from collections.abc import Callable, Sequence
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from ._errors import DistributedError

Sizes = npt.NDArray[np.int64]


class Communicator(Protocol):
    """Some processes, or threads, that work together.

    Its calls are made by one thread at a time, which is not the one that called the library, and by
    all ranks in the same order. Messages may have any size, also none.
    """

    @property
    def rank(self) -> int:
        """The number of this one, from 0 to ``size - 1``."""

    @property
    def size(self) -> int:
        """How many there are."""

    def allgather(self, message: bytes, /) -> Sequence[bytes]:
        """What every rank gave, by rank."""

    def alltoall(self, messages: list[bytes], /) -> Sequence[bytes]:
        """Gives ``messages[r]`` to each rank r; what each rank gave to this one."""


class Ranks:
    """Those of a communicator, which meet before they work.

    Whatever a rank finds wrong with its own arguments it keeps, and tells the others when they
    meet; otherwise they would wait for it for ever.
    """

    def __init__(self, communicator: Any) -> None:
        calls = _calls_of(communicator)
        self.rank: int = calls.rank
        self.size: int = calls.size
        self.allgather = calls.allgather
        self.alltoall = calls.alltoall
        self._failure: BaseException | None = None
        self._threads = 0
        self._options = ""

    def prepare(self, options: object, threads: int) -> None:
        """What all ranks must agree in, and the threads of this one; 0 for its share."""
        self._options = repr(options)
        self._threads = threads

    def fail(self, error: BaseException) -> None:
        """Keeps why this rank cannot begin."""
        self._failure = error

    def meet(self) -> int:
        """Returns the number of threads for this rank, if all ranks can begin."""
        is_interrupted = isinstance(self._failure, KeyboardInterrupt)
        text = None if self._failure is None else " ".join(str(self._failure).split())[:500]
        mine = [is_interrupted, text, self._options, platform.node()]
        told = [json.loads(bytes(each)) for each in self.allgather(json.dumps(mine).encode())]
        if self._failure is not None:
            raise self._failure
        for rank, (was_interrupted, failure, _, _) in enumerate(told):
            if was_interrupted:
                raise KeyboardInterrupt("another rank was interrupted")
            if failure is not None:
                raise DistributedError(f"rank {rank}, arguments: {failure}", rank)
        for rank, (_, _, options, _) in enumerate(told):
            if options != told[0][2]:
                raise DistributedError(f"rank {rank}, arguments: not those of rank 0", rank)
        num_here = [node for _, _, _, node in told].count(platform.node())
        return self._threads or max(1, (os.cpu_count() or 1) // num_here)


def _calls_of(communicator: Any) -> Communicator:
    """Of what users pass; None is all processes of MPI."""
    if communicator is None:
        try:
            from mpi4py import MPI
        except ModuleNotFoundError as error:
            raise ModuleNotFoundError(
                "rondel.distributed needs mpi4py, which is not there (pip install mpi4py), or "
                "another communicator: comm="
            ) from error
        communicator = MPI.COMM_WORLD
    loaded = sys.modules.get("mpi4py.MPI")
    if loaded is not None and isinstance(communicator, loaded.Comm):
        return MpiCalls(communicator)
    for name in ("rank", "size", "allgather", "alltoall"):
        if not hasattr(communicator, name):
            raise TypeError(f"comm has no {name}: it is a {type(communicator).__name__}")
    return communicator


class MpiCalls:
    """Those of mpi4py's communicator, for messages of any size.

    Its calls for objects end at 2 GiB, and so do counts of MPI before version 4; so messages go
    through its calls for memory, in pieces. Collective calls alone: they meet no other message of
    the program.
    """

    def __init__(self, communicator: Any, max_bytes: int = 1 << 30) -> None:
        from mpi4py import MPI

        if communicator.is_inter:
            raise TypeError("comm is an intercommunicator, which has no ranks of its own")
        if MPI.Query_thread() < MPI.THREAD_SERIALIZED:
            raise RuntimeError(
                "MPI was initialized for one thread alone; mpi4py.rc.thread_level = 'serialized', "
                "set before mpi4py.MPI is imported, is enough"
            )
        self._mpi: Any = MPI
        self._communicator = communicator
        self.rank: int = communicator.rank
        self.size: int = communicator.size
        self._most = max(1, max_bytes // self.size)  # from one rank to one other at once

    def allgather(self, message: bytes) -> list[bytes]:
        """What every rank gave, by rank."""
        sizes = np.empty(self.size, np.int64)
        self._communicator.Allgather(np.array([len(message)], np.int64), sizes)

        def send(begin: int, received: list[Any]) -> None:
            piece = message[begin : begin + self._most]
            self._communicator.Allgatherv([piece, self._mpi.BYTE], received)

        return self._receive(sizes, int(sizes.max()), send)

    def alltoall(self, messages: list[bytes]) -> list[bytes]:
        """Gives ``messages[r]`` to each rank r; what each rank gave to this one."""
        given = np.array([len(message) for message in messages], np.int64)
        sizes = np.empty(self.size, np.int64)
        self._communicator.Alltoall(given, sizes)
        longest = np.empty(1, np.int64)
        self._communicator.Allreduce(given.max(keepdims=True), longest, self._mpi.MAX)

        def send(begin: int, received: list[Any]) -> None:
            pieces = b"".join(message[begin : begin + self._most] for message in messages)
            counts, starts = self._layout(given, begin)
            self._communicator.Alltoallv([pieces, counts, starts, self._mpi.BYTE], received)

        return self._receive(sizes, int(longest[0]), send)

    def _layout(self, sizes: Sizes, begin: int) -> tuple[Sizes, Sizes]:
        """How much of each message is in the pieces from there, and where it lies."""
        counts = np.clip(sizes - begin, 0, self._most)
        return counts, np.cumsum(counts) - counts

    def _receive(
        self, sizes: Sizes, longest: int, send: Callable[[int, list[Any]], None]
    ) -> list[bytes]:
        parts: list[list[memoryview]] = [[] for _ in sizes]
        for begin in range(0, longest, self._most):
            counts, starts = self._layout(sizes, begin)
            pieces = self._allocate(int(counts.sum()))
            send(begin, [pieces, counts, starts, self._mpi.BYTE])
            for rank in np.flatnonzero(counts):
                parts[rank].append(pieces[starts[rank] : starts[rank] + counts[rank]].data)
        # The library takes memory of any kind.
        return [each[0] if len(each) == 1 else b"".join(each) for each in parts]  # type: ignore[misc]

    def _allocate(self, size: int) -> npt.NDArray[np.uint8]:
        """Memory to receive in; where one rank has none, all raise."""
        memory = None
        with contextlib.suppress(MemoryError):
            memory = np.empty(size, np.uint8)
        have_all = np.empty(1, np.int32)
        mine = np.array([memory is not None], np.int32)
        self._communicator.Allreduce(mine, have_all, self._mpi.MIN)
        if memory is None or not have_all[0]:
            raise MemoryError(
                f"not enough memory on {'this' if memory is None else 'another'} rank"
            )
        return memory
