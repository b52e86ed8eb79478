# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Compares what a program prints with a file.

    output_test.py PROGRAM EXPECTED
"""

import pathlib
import subprocess
import sys

printed = subprocess.run([sys.argv[1]], capture_output=True, text=True, check=True).stdout
expected = pathlib.Path(sys.argv[2]).read_text(encoding="utf-8")
if printed != expected:
    sys.exit(f"printed:\n{printed}\nexpected:\n{expected}")
