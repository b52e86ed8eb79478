# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""rondel.distributed by processes of MPI, through mpi4py; and the example of the guide.

python_test.py MPIEXEC... -- PYTHON
"""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

split = sys.argv.index("--")
MPIEXEC = sys.argv[1:split]
(PYTHON,) = sys.argv[split + 1 :]
del sys.argv[1:]

HERE = pathlib.Path(__file__).resolve().parent
GUIDE = HERE.parents[1] / "docs/guide/distributed.md"


def run_ranks(num_ranks, *arguments):
    """What one of them raises ends all."""
    return subprocess.run(
        [*MPIEXEC, "-n", str(num_ranks), PYTHON, "-m", "mpi4py", *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )


class Ranks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def assert_ends_well(self, num_ranks, *arguments):
        result = run_ranks(num_ranks, HERE / "python_ranks.py", num_ranks, *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_results_are_those_of_one_process(self):
        for num_ranks in (1, 2, 4):
            self.assert_ends_well(num_ranks, "results", self.folder)

    def test_messages_in_pieces(self):
        for num_ranks in (1, 3):
            self.assert_ends_well(num_ranks, "pieces")

    def test_failures_are_those_of_all(self):
        self.assert_ends_well(3, "failures")

    def test_what_is_refused(self):
        self.assert_ends_well(2, "refused", "an intercommunicator")
        result = run_ranks(
            1, "--rc=thread_level=funneled", HERE / "python_ranks.py", 1, "refused", "for one thread"
        )
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_an_interrupt_ends_all(self):
        self.assert_ends_well(3, "interrupt")

    def test_a_communicator_that_fails_ends_all(self):
        result = run_ranks(3, HERE / "python_ranks.py", 3, "lost")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("ConnectionError: the line is cut", result.stderr)

    def test_the_example_of_the_guide(self):
        text = GUIDE.read_text(encoding="utf-8")
        program, said = re.search(
            r"^```python\n(from mpi4py.*?)^```$.*?^```text\n(.*?)^```$", text, re.M | re.S
        ).groups()
        (self.folder / "program.py").write_text(program, encoding="utf-8")
        result = run_ranks(4, self.folder / "program.py")
        self.assertEqual((result.stdout, result.returncode), (said, 0), result.stderr)


if __name__ == "__main__":
    unittest.main()
