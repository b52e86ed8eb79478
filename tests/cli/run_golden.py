#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Runs a transcript of command lines and compares every word.

    run_golden.py TOOL TRANSCRIPT [--update]

A transcript is read by people first. Its commands run one after the other, by sh, in a directory
that holds the files of inputs/ and those that inputs.py makes:

    $ rondel delaunay octahedron.xyz -o out.npy     a command
    | 6 sites: 6 vertices, 0 duplicates             a line on standard output
    ! rondel: ...                                   a line on standard error
    + out.npy                                       a file that is new or has changed
    [1]                                             the exit status, unless it is 0

Times are written "T s". A command that fails must leave the directory as it was, and says so in
exactly one line on standard error. With --update the transcript is rewritten from what happens.
"""

import argparse
import difflib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import inputs  # noqa: E402 (after the line above)

HERE = pathlib.Path(__file__).resolve().parent


def snapshot(directory):
    """Names of all files with what tells whether one has changed."""
    return {
        entry.name: (entry.stat(follow_symlinks=False).st_ino,
                     entry.stat(follow_symlinks=False).st_mtime_ns)
        for entry in os.scandir(directory)
    }


def normalized(text):
    """What does not depend on the machine."""
    return re.sub(r"\b\d+\.\d+ s\b", "T s", text)


def run(command, directory, environment):
    """The lines of a transcript that follow the command."""
    before = snapshot(directory)
    done = subprocess.run(["/bin/sh", "-c", command], cwd=directory, env=environment, text=True,
                          capture_output=True, timeout=120, check=False)
    after = snapshot(directory)
    changed = sorted(name for name in after if after[name] != before.get(name))
    gone = sorted(name for name in before if name not in after)
    lines = ["| " + line for line in normalized(done.stdout).splitlines()]
    lines += ["! " + line for line in normalized(done.stderr).splitlines()]
    lines += ["+ " + name for name in changed] + ["- " + name for name in gone]
    if done.returncode != 0:
        lines.append(f"[{done.returncode}]")
        errors = len(done.stderr.splitlines())
        if changed or gone or errors > 1:
            lines.append(f"FAILED UNCLEANLY: {errors} lines, files {changed + gone}")
    return [line.rstrip() for line in lines]


def replay(transcript, directory, environment):
    """The transcript as it should be: comments and commands kept, results from running."""
    result = []
    for line in transcript.splitlines():
        if line.startswith("$ "):
            result.append(line)
            result += run(line[2:], directory, environment)
        elif not line.startswith(("| ", "! ", "+ ", "- ", "[", "|", "!")):
            result.append(line)
    return "\n".join(result) + "\n"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tool", type=pathlib.Path)
    parser.add_argument("transcript", type=pathlib.Path)
    parser.add_argument("--update", action="store_true")
    arguments = parser.parse_args()
    expected = arguments.transcript.read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as directory:
        for source in (HERE / "inputs").iterdir():
            shutil.copy(source, directory)
        inputs.make(pathlib.Path(directory))
        environment = dict(os.environ, LC_ALL="C.UTF-8", PYTHONPATH=str(HERE),
                           PYTHONDONTWRITEBYTECODE="1",
                           PATH=f"{arguments.tool.resolve().parent}:{os.environ['PATH']}")
        actual = replay(expected, directory, environment)
    if "FAILED UNCLEANLY" in actual:
        sys.exit(actual)
    if arguments.update:
        arguments.transcript.write_text(actual, encoding="utf-8")
    elif actual != expected:
        sys.exit("".join(difflib.unified_diff(expected.splitlines(True), actual.splitlines(True),
                                              "expected", "actual")))


if __name__ == "__main__":
    main()
