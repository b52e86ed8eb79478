# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The modules of the Python package do not import each other in circles.

    python_imports_test.py SOURCE_FOLDER
"""

import ast
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv.pop(1))


def imports(package):
    """The modules of the package, each with those that it imports, anywhere in it."""
    names = {path.stem for path in package.glob("*.py")}
    found = {}
    for path in sorted(package.glob("*.py")):
        found[path.stem] = set()
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and node.level == 1:
                wanted = [node.module] if node.module else [alias.name for alias in node.names]
                found[path.stem] |= names.intersection(wanted)
    return found


def circle(graph):
    """Modules that import each other, or that import only such; none if there is no circle."""
    left = {name: set(wanted) for name, wanted in graph.items()}
    while free := {name for name, wanted in left.items() if not wanted}:
        left = {name: wanted - free for name, wanted in left.items() if name not in free}
    return set(left)


class Imports(unittest.TestCase):
    def test_the_package_has_no_circles(self):
        graph = imports(ROOT / "bindings" / "python" / "rondel")
        self.assertIn("_arrays", graph["_delaunay"])
        self.assertEqual(circle(graph), set())

    def test_a_circle_is_found(self):
        texts = {
            "a": "from . import b\n",
            "b": "def f():\n    from .c import g\n",
            "c": "from .a import h\nfrom ._core import i\nimport b\n",
            "d": "from ._core import i\n",
        }
        with tempfile.TemporaryDirectory() as folder:
            for name, text in texts.items():
                pathlib.Path(folder, f"{name}.py").write_text(text, encoding="utf-8")
            graph = imports(pathlib.Path(folder))
        self.assertEqual(graph, {"a": {"b"}, "b": {"c"}, "c": {"a"}, "d": set()})
        self.assertEqual(circle(graph), {"a", "b", "c"})


if __name__ == "__main__":
    unittest.main()
