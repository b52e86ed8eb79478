# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""A copy of the code in build/mutants, which mutants may change, its build, and its tests with limits."""

import math
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
TREE = ROOT / "build" / "mutants" / "tree"
BUILD = TREE / "build" / "mutants"
LOG = ROOT / "build" / "mutants" / "log.txt"
MEMORY = 8 << 30  # a mutant may ask for all there is
SCALES = (0.2, 1)  # of random tests: most mutants are found by few
MAX_PATIENCE = 3600  # seconds, also of waiting: the machine may be busy


def run(command):
    """Whether the command succeeds, and what it prints, which goes to the log as well."""
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    with open(LOG, "ab") as log:
        log.write(f"\n$ {' '.join(map(str, command))}\n".encode() + done.stdout)
    return done.returncode == 0, done.stdout.decode("utf-8", "replace")


def copy_tree(changed=None):
    """The tracked files as they are now, with the texts of `changed` (name: bytes) instead of their own; a file that stays
    the same keeps its time, for the build, and one that is tracked no longer goes."""
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    names = set(listed.split("\0"))
    for old in TREE.rglob("*"):
        name = old.relative_to(TREE)
        if old.is_file() and name.parts[0] != "build" and name.as_posix() not in names:
            old.unlink()
    for name in sorted(filter(None, names)):
        source, target = ROOT / name, TREE / name
        if not source.is_file():
            continue  # deleted, and not yet committed
        content = (changed or {}).get(name) or source.read_bytes()
        if target.exists() and target.read_bytes() == content:
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source, target)
        if name in (changed or {}):
            target.write_bytes(content)


def is_of_python(test):
    """Or else of C++ or of the tool."""
    return test.startswith("python.")


def configure(with_python=False):
    """A build that compiles quickly."""
    launcher = [f"-DCMAKE_CXX_COMPILER_LAUNCHER={path}"
                for path in [shutil.which("ccache")] if path is not None]
    return run(["cmake", "-S", TREE, "-B", BUILD, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=RelWithDebInfo",
                "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -g0", "-DRONDEL_BUILD_TESTS=ON", "-DCMAKE_UNITY_BUILD=OFF",
                "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", f"-DRONDEL_BUILD_PYTHON={'ON' if with_python else 'OFF'}",
                f"-DPython_EXECUTABLE={ROOT / 'build' / 'python' / 'bin' / 'python'}", *launcher])[0]


def is_of_ctest(test):
    """Or else a program of tests, perhaps with a filter: "bulk_test:bulk_bounds.*"."""
    return "." in test.partition(":")[0]


def target_of(test):
    """What must be built for a test."""
    if test.startswith("same_bytes.weights"):
        return "same_bytes_weights"
    if test.startswith("same_bytes.overlays"):
        return "same_bytes_overlay"
    if test.startswith("same_bytes.meshes"):
        return "same_bytes_meshes"
    if test.startswith("same_bytes."):
        return "same_bytes"
    if test.startswith("fuzz."):
        return test.replace("fuzz.", "replay_")
    if is_of_python(test):
        return "rondel_python"
    return "rondel_tool" if is_of_ctest(test) else test.partition(":")[0]


def build(tests):
    """Whether what the tests run can be built, as far as it can, and what the compiler says."""
    return run(["cmake", "--build", BUILD, "--target", *sorted({target_of(t) for t in tests}), "--", "-k", "0"])


def set_limits(seconds):
    """Of the process that becomes a test, and of all that it starts."""
    resource.setrlimit(resource.RLIMIT_DATA, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))


def ends_well(command, limit):
    """Whether a test succeeds within `limit` seconds of computing; if not, ends it and all that it
    started."""
    with open(LOG, "ab") as log:
        log.write(f"\n$ {' '.join(map(str, command))}\n".encode())
        log.flush()
        with subprocess.Popen(command, cwd=BUILD, stdout=log, stderr=log, start_new_session=True,
                              preexec_fn=lambda: set_limits(math.ceil(limit))) as process:
            try:
                status = process.wait(MAX_PATIENCE)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                status = process.wait()
        log.write(f"status {status}, may compute for {limit:.0f} s\n".encode())
        return status == 0


def passes(test, scale, limit):
    """Whether a test succeeds in time; random ones are repeated `scale` times as often as usual."""
    os.environ["RONDEL_TEST_SCALE"] = str(scale)
    program, _, only = test.partition(":")
    command = ([BUILD / "bin" / program, f"--gtest_filter={only or '*'}", "--gtest_fail_fast",
                "--gtest_brief=1"] if not is_of_ctest(test)
               else ["ctest", "-R", f"^{test}$", "--no-tests=error", "--output-on-failure"])
    return ends_well(command, limit)


def cases_of(test):
    """The cases of a program of tests one by one, "program:suite.case"; a test of ctest as it is."""
    if is_of_ctest(test):
        return [test]
    program, _, only = test.partition(":")
    listed = subprocess.run([BUILD / "bin" / program, f"--gtest_filter={only or '*'}", "--gtest_list_tests"],
                            check=True, capture_output=True, text=True).stdout
    cases = []
    suite = ""
    for line in listed.splitlines():
        name = line.split("#")[0].strip()
        if line.startswith("  "):
            cases.append(f"{program}:{suite}{name}")
        elif name.endswith("."):
            suite = name
    return cases


def time_computed():
    """By all that has been started and has ended, in seconds."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def time_without_mutant(test):
    """How long a test computes where random tests are repeated least."""
    start = time_computed()
    if not passes(test, SCALES[0], MAX_PATIENCE):
        sys.exit(f"{test} fails without a mutant: {LOG} says why")
    return time_computed() - start
