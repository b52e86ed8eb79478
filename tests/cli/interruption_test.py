#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""A run that is cut short: by a signal, a full disk, a reader that went away."""

import json
import os
import pathlib
import pty
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

TOOL = pathlib.Path(sys.argv.pop(1)).resolve()
GENERATE = ["generate", "uniform", "-n", "1000000", "--quiet", "-o"]


def written_by(process, output):
    """How many bytes the process has written to files of the output's folder."""
    total = 0
    for link in pathlib.Path(f"/proc/{process.pid}/fd").iterdir():
        try:
            if os.readlink(link).startswith(str(output.parent)):
                total += link.stat().st_size
        except OSError:
            continue  # closed meanwhile
    return total


def survivable_signals(folder):
    """SIGKILL leaves no file only where files can be made without a name."""
    signals = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]
    try:
        os.close(os.open(folder, os.O_TMPFILE | os.O_WRONLY))
    except OSError:
        return signals
    return signals + [signal.SIGKILL]


class Interruption(unittest.TestCase):
    def setUp(self):
        signal.signal(signal.SIGHUP, signal.SIG_DFL)  # programs would inherit what nohup ignores
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name).resolve()

    def interrupt(self, number, output, prefix=()):
        """Sends the signal while the output is being written; tells the exit status."""
        if not os.path.isdir("/proc/self/fd"):
            self.skipTest("needs /proc to see what is being written")
        process = subprocess.Popen([*prefix, TOOL, *GENERATE, output], stderr=subprocess.PIPE)
        try:
            while process.poll() is None and written_by(process, output) < 1 << 20:
                time.sleep(0.0005)
            self.assertIsNone(process.poll(), "ended before it could be interrupted")
            process.send_signal(number)
            process.communicate(timeout=30)
        finally:
            process.kill()
            process.wait()
        return process.returncode

    def test_signals_leave_no_file(self):
        for number in survivable_signals(self.folder):
            with self.subTest(signal=number.name):
                self.assertEqual(self.interrupt(number, self.folder / "out.xyz"), -number)
                self.assertEqual(os.listdir(self.folder), [])

    def test_signals_leave_the_older_file(self):
        output = self.folder / "out.xyz"
        for number in survivable_signals(self.folder):
            output.write_text("1 0 0\n", encoding="ascii")
            self.assertEqual(self.interrupt(number, output), -number)
            self.assertEqual(output.read_text(encoding="ascii"), "1 0 0\n")
            self.assertEqual(os.listdir(self.folder), ["out.xyz"])

    def test_an_ignored_signal_stays_ignored(self):
        ignoring = ["/bin/sh", "-c", 'trap "" HUP; exec "$@"', "sh"]
        output = self.folder / "out.xyz"
        self.assertEqual(self.interrupt(signal.SIGHUP, output, ignoring), 0)
        self.assertEqual(os.listdir(self.folder), ["out.xyz"])

    def test_a_full_file_system_is_told_and_left_clean(self):
        if os.geteuid() != 0 or shutil.which("mount") is None:
            self.skipTest("needs the right to mount")
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=256k", "none", self.folder],
                                 capture_output=True, check=False)
        if mounted.returncode != 0:
            self.skipTest("mounting is not allowed here")
        try:
            done = subprocess.run([TOOL, *GENERATE, "out.npy"], cwd=self.folder, text=True,
                                  capture_output=True, timeout=60, check=False)
            self.assertEqual((done.returncode, done.stderr),
                             (1, "rondel: out.npy: No space left on device\n"))
            self.assertEqual(os.listdir(self.folder), [])
        finally:
            subprocess.run(["umount", self.folder], check=True)

    def test_a_directory_without_the_right_to_write(self):
        if os.geteuid() == 0:
            self.skipTest("root may write everywhere")
        self.folder.chmod(0o500)
        done = subprocess.run([TOOL, *GENERATE, "out.npy"], cwd=self.folder, text=True,
                              capture_output=True, timeout=60, check=False)
        self.folder.chmod(0o700)
        self.assertEqual((done.returncode, done.stderr),
                         (1, "rondel: out.npy: Permission denied\n"))

    def test_an_interrupted_tessellation_is_written_as_it_is(self):
        try:
            terminal, other_end = pty.openpty()
        except OSError as error:
            self.skipTest(f"no pseudo-terminal here: {error}")
        output = self.folder / "mesh.nc"
        process = subprocess.Popen([TOOL, "mesh", "scvt", "-n", "40000", "--tolerance", "1e-12", "-o", output],
                                   stdout=subprocess.PIPE, stderr=other_end, text=True)
        os.close(other_end)
        shown = b""
        while b", energy" not in shown:  # now it heeds the signal
            shown += os.read(terminal, 4096)
        process.send_signal(signal.SIGINT)
        try:
            while more := os.read(terminal, 4096):
                shown += more
        except OSError:
            pass  # the other end is closed
        os.close(terminal)
        told = process.communicate(timeout=60)[0]
        self.assertEqual(process.returncode, 1)
        self.assertRegex(told, r"\Awrote \d+ cells to ")
        self.assertIn(b"mesh.nc: not converged (stopped after ", shown)
        self.assertEqual(os.listdir(self.folder), ["mesh.nc"])
        done = subprocess.run([TOOL, "mesh", "quality", output, "--json"], capture_output=True, text=True,
                              timeout=60, check=True)
        quality = json.loads(done.stdout)
        self.assertIn(f"wrote {quality['num_cells']} cells", told)

    def to_nobody(self, *command):
        """Exit status and standard error of a run whose standard output nobody reads."""
        reader, writer = os.pipe()
        os.close(reader)
        done = subprocess.run([*command], stdout=writer, stderr=subprocess.PIPE, text=True,
                              timeout=60, check=False, cwd=self.folder)
        os.close(writer)
        return done.returncode, done.stderr

    def test_a_reader_that_goes_away_ends_the_tool_silently(self):
        self.assertEqual(self.to_nobody(TOOL, "--help"), (-signal.SIGPIPE, ""))
        self.assertEqual(self.to_nobody(TOOL, *GENERATE, "-"), (-signal.SIGPIPE, ""))
        self.assertEqual(os.listdir(self.folder), [])

    def test_a_broken_pipe_is_one_line_where_its_signal_is_ignored(self):
        ignoring = ["/bin/sh", "-c", 'trap "" PIPE; exec "$@"', "sh"]
        self.assertEqual(self.to_nobody(*ignoring, TOOL, "--help"),
                         (1, "rondel: <stdout>: Broken pipe\n"))

    def progress(self, *options):
        """What a terminal shows on standard error: nothing of work of less than 0.3 seconds."""
        sites = self.folder / "sites.npy"
        is_slow = float(os.environ.get("RONDEL_TEST_SCALE", 1)) < 1  # a sanitizer looks on
        number = "500000" if is_slow else "4000000"
        subprocess.run([TOOL, "generate", "uniform", "-n", number, "--quiet", "-o", sites],
                       check=True)
        try:
            terminal, other_end = pty.openpty()
        except OSError as error:
            self.skipTest(f"no pseudo-terminal here: {error}")
        process = subprocess.Popen([TOOL, "delaunay", sites, "-o", self.folder / "out.npy",
                                    "--threads", "1", *options],
                                   stdout=subprocess.DEVNULL, stderr=other_end)
        os.close(other_end)
        shown = b""
        try:
            while chunk := os.read(terminal, 4096):
                shown += chunk
        except OSError:
            pass  # the other end is closed
        os.close(terminal)
        self.assertEqual(process.wait(timeout=60), 0)
        return shown.decode()

    def test_a_terminal_shows_progress_and_is_cleared(self):
        shown = self.progress()
        lines = [line for line in shown.split("\r\x1b[K") if line]
        self.assertGreater(len(lines), 0)
        for line in lines:  # the time that is left is there once it can be told
            self.assertRegex(line, r"^rondel: [a-z]+ \d+ %(, (\d+ min )?\d+ s left)?$")
        self.assertTrue(shown.endswith("\r\x1b[K"))

    def test_quiet_shows_no_progress(self):
        self.assertEqual(self.progress("--quiet"), "")


if __name__ == "__main__":
    unittest.main()
