#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""netCDF-C reads a variable of more than 4 GiB (netcdf_large_test.py NETCDF_LARGE [--whole])."""

import pathlib
import subprocess
import sys
import tempfile

LAST = 2**29 + 1


def main():
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "large.nc"
        subprocess.run([*sys.argv[1:2], path, *sys.argv[2:]], check=True)
        assert path.stat().st_size > 2**32
        kind = subprocess.run(["ncdump", "-k", path], check=True, capture_output=True, text=True).stdout
        assert kind.strip() == "cdf5", kind
        command = ["ncks", "-H", "-C", "-s", "%.17g ", "-v", "few,many,last", "-d", f"n,{LAST - 1},{LAST}", path]
        text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        assert sorted(float(number) for number in text.split()) == [0.5, 1.5, LAST - 1, LAST], text


if __name__ == "__main__":
    main()
