# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What the command line asks for."""

import dataclasses
import os
import pathlib

from .runs import Limits

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


@dataclasses.dataclass(frozen=True)
class Settings:
    programs: pathlib.Path  # rondel_bench and the rest
    narrow_programs: pathlib.Path  # rondel_bench without wide vectors, or nothing
    out: pathlib.Path
    node_packages: pathlib.Path  # the folder with node_modules
    limits: Limits
    max_log2: int  # of Rondel alone
    peers_max_log2: int
    shrink: int  # inputs of fixed size are divided by this
    stations: tuple = (ROOT / "data" / "stations.csv",)

    def size(self, n):
        return max(n // self.shrink, 1024)

    def sizes(self, largest):
        """2^10, 2^12, ... and the largest."""
        return [2**k for k in sorted({*range(10, largest + 1, 2), largest})]

    def threads(self):
        """1, 2, 4, ... and the number of cores."""
        cores = len(os.sched_getaffinity(0))
        return sorted({1, cores, *(2**k for k in range(cores.bit_length()) if 2**k <= cores)})
