# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The shared library of the C interface, as another language loads it.

    library_test.py LIBRARY HEADER
"""

import ctypes
import pathlib
import re
import subprocess
import sys
import unittest

HEADER = pathlib.Path(sys.argv.pop()).read_text(encoding="utf-8")
LIBRARY = sys.argv.pop()


class Library(unittest.TestCase):
    def test_it_shows_what_the_header_declares(self):
        declared = set(re.findall(r"\b(rondel_\w+)\(", re.sub(r"/\*.*?\*/", "", HEADER, flags=re.S)))
        names = subprocess.run(["nm", "--dynamic", "--defined-only", "--format=posix", LIBRARY],
                               check=True, capture_output=True, text=True).stdout
        shown = {line.split()[0] for line in names.splitlines()}
        self.assertEqual(shown, declared)

    def test_a_language_that_reads_no_header_can_call_it(self):
        rondel = ctypes.CDLL(LIBRARY)
        rondel.rondel_error_message.restype = ctypes.c_char_p
        rondel.rondel_faces.restype = ctypes.POINTER(ctypes.c_uint32)
        rondel.rondel_num_faces.restype = ctypes.c_size_t
        octahedron = (ctypes.c_double * 18)(1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1)
        made = ctypes.c_void_p()
        status = rondel.rondel_delaunay(octahedron, ctypes.c_size_t(6), None, None, ctypes.byref(made))
        self.assertEqual(status, 0, rondel.rondel_error_message())
        number = rondel.rondel_num_faces(made)
        faces = rondel.rondel_faces(made)
        found = {frozenset(faces[3 * f : 3 * f + 3]) for f in range(number)}
        self.assertEqual(found, {frozenset((x, y, z)) for x in (0, 1) for y in (2, 3) for z in (4, 5)})
        rondel.rondel_triangulation_free(made)


if __name__ == "__main__":
    unittest.main()
