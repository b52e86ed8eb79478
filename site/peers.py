# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What the pages "coming from" run: programs in other languages, whose output a cell of the page shows.

scripts/site sets RONDEL_ROOT, RONDEL_SITE_BUILD and RONDEL_SITE_NODE. A program that fails, fails the page.
"""

import hashlib
import os
import pathlib
import subprocess

ROOT = pathlib.Path(os.environ["RONDEL_ROOT"])
BUILD = pathlib.Path(os.environ["RONDEL_SITE_BUILD"])


def run(*command, **more):
    answer = subprocess.run(command, capture_output=True, text=True, **more)
    print(answer.stdout + answer.stderr, end="")
    if answer.returncode:
        raise RuntimeError(f"{command[0]} ended with {answer.returncode}")


def shell(script):
    """Commands as the page shows them, in a folder of their own; `rondel` is the tool."""
    folder = BUILD / "shell"
    folder.mkdir(exist_ok=True)
    if not (folder / "data").exists():
        (folder / "data").symlink_to(ROOT / "data")
    print(script)
    path = f"{ROOT / 'build/dev/bin'}{os.pathsep}{os.environ['PATH']}"
    run("sh", "-e", "-c", script, cwd=folder, env={**os.environ, "PATH": path})


def cpp(source, *libraries):
    """A program beside the page, against the library that scripts/site built; compiled when it or the library changed."""
    library = ROOT / "build/dev/src/librondel.a"
    headers = sorted((ROOT / "include/rondel").glob("*.h"))
    state = hashlib.sha256(b"".join(path.read_bytes() for path in [pathlib.Path(source), library, *headers])).hexdigest()
    program = BUILD / f"{pathlib.Path(source).stem}-{state[:16]}"
    if not program.exists():
        includes = [f"-I{ROOT / 'include'}", f"-I{ROOT / 'build/dev/include'}"]
        links = [str(library), *(f"-l{name}" for name in (*libraries, "tbb"))]
        subprocess.run(["c++", "-std=c++20", "-O1", "-pthread", *includes, source, *links, "-o", program], check=True)
    run(str(program))


def node(source):
    """A program beside the page; it finds the peer and the package."""
    copy = pathlib.Path(os.environ["RONDEL_SITE_NODE"], pathlib.Path(source).name)
    copy.write_bytes(pathlib.Path(source).read_bytes())
    run("node", str(copy))


def python(source):
    """A program beside the page, with Debian's Python and NumPy, for peers that were compiled for older ones."""
    paths = [str(ROOT / "build/dev/python"), str(ROOT / "build/site-peers")]
    run(str(ROOT / "build/python/bin/python"), source, env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)})
