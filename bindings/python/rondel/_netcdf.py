# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The library netCDF-C, which reads and writes netCDF-4: where Python has it."""

from __future__ import annotations

import pathlib
import sys

# The wheels of netCDF4 carry it below a folder of sys.path, for Linux, macOS and Windows.
_IN_WHEELS = (
    "netcdf4.libs/libnetcdf-*.so*",
    "netCDF4.libs/libnetcdf-*.so*",
    "netCDF4/.dylibs/libnetcdf*.dylib",
    "netcdf4.libs/netcdf-*.dll",
    "netCDF4.libs/netcdf-*.dll",
)
# conda installs it below sys.prefix.
_IN_CONDA = ("lib/libnetcdf.so", "lib/libnetcdf.dylib", "Library/bin/netcdf.dll")


def netcdf_library() -> str | None:
    """Return the path of the library, or None where Python has none; the system may have one.

    Returns
    -------
    str or None
        The library of the wheel of netCDF4, which is not imported, or that of conda.

    """
    for entry in sys.path:
        folder = pathlib.Path(entry or ".")
        for pattern in _IN_WHEELS:
            if not (folder / pattern.split("/", 1)[0]).is_dir():
                continue
            for path in sorted(folder.glob(pattern)):
                return str(path)
    for name in _IN_CONDA:
        path = pathlib.Path(sys.prefix, name)
        if path.is_file():
            return str(path)
    return None
