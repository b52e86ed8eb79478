# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""``python -m rondel``: the command `rondel` that came with the package."""

from __future__ import annotations

import importlib.metadata
import os
import pathlib
import shutil
import subprocess
import sys

from . import __version__


def installed_files() -> list[pathlib.Path]:
    """Returns the files of the installed package; none if another one runs."""
    try:
        files = importlib.metadata.files("rondel") or []
    except importlib.metadata.PackageNotFoundError:
        return []
    paths = [pathlib.Path(str(file.locate())) for file in files]
    here = pathlib.Path(__file__).resolve()
    return paths if any(path.resolve() == here for path in paths if path.suffix == ".py") else []


def command() -> str | None:
    """Returns the file of the command: that of the package, or one of its version in the PATH."""
    name = "rondel.exe" if os.name == "nt" else "rondel"
    for path in installed_files():
        if path.name == name and os.access(path, os.X_OK):
            return str(path)
    found = shutil.which("rondel")
    if found is not None:
        said = subprocess.run([found, "--version"], capture_output=True, text=True, check=False)
        if said.stdout.strip() == f"rondel {__version__}":
            return found
    return None


def main() -> int:
    """Runs the command with the arguments of this process."""
    found = command()
    if found is None:
        print(
            f"rondel: there is no command rondel {__version__}: this package was built without it,"
            " and the PATH has none of this version",
            file=sys.stderr,
        )
        return 2
    arguments = [found, *sys.argv[1:]]
    if os.name == "nt":
        return subprocess.run(arguments, check=False).returncode
    os.execv(found, arguments)


if __name__ == "__main__":
    sys.exit(main())
