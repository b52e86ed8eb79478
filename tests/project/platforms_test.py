#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Nothing of the library depends on the system or on the C library but where that is its task.

    platforms_test.py SOURCE_FOLDER
"""

import re
import sys
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1))

# C libraries round these differently; exact/angles.h, exact/angles.h and exact/vector.h have what is needed.
INEXACT = re.compile(
    r"\b(?:std::)?(?:sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|asinh|acosh|atanh|exp|exp2|expm1|log|log2|log10"
    r"|log1p|pow|cbrt|hypot|erf|erfc|tgamma|lgamma)\((?!\))"
)
SYSTEM = re.compile(r"#.*\b(?:__linux__|__unix__|__APPLE__|_WIN32|__MINGW32__|_MSC_VER|__BYTE_ORDER__)\b")
SYSTEM_HEADER = re.compile(r"#include <(?:unistd|fcntl|io|windows|psapi|shellapi|pthread|dlfcn|sys/\w+)\.h>")
BYTE_ORDER = re.compile(r"static_assert\(.*endian")


def sources(*folders):
    for folder in folders:
        yield from (p for p in sorted((SOURCE / folder).rglob("*")) if p.suffix in (".h", ".cpp"))


def is_for_one_system(path):
    return path.stem.endswith(("_posix", "_windows"))


class Platforms(unittest.TestCase):
    def expect_none(self, pattern, paths):
        found = []
        for path in paths:
            for number, line in enumerate(path.read_text().splitlines(), 1):
                code = line.split("//")[0]
                if pattern.search(code):
                    found.append(f"{path.relative_to(SOURCE)}:{number}: {line.strip()}")
        self.assertEqual(found, [])

    def test_results_do_not_depend_on_the_c_library(self):
        self.expect_none(INEXACT, sources("src", "include", "bindings/c/src"))

    def test_the_system_is_known_to_its_layer_alone(self):
        outside = [p for p in sources("src", "cli", "inputs") if "system" not in p.relative_to(SOURCE).parts]
        self.expect_none(SYSTEM, outside)
        self.expect_none(SYSTEM_HEADER, [p for p in outside if not is_for_one_system(p)])

    def test_any_order_of_bytes_will_do(self):
        self.expect_none(BYTE_ORDER, sources("src", "include", "cli", "bindings/c/src"))

    def test_each_system_has_its_files(self):
        for path in sources("src", "cli"):
            if path.stem.endswith("_posix"):
                self.assertTrue(path.with_stem(path.stem.replace("_posix", "_windows")).exists(), path)


if __name__ == "__main__":
    unittest.main()
