# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The inputs that are not text, or that no editor would leave as they are."""

import math
import os
import struct
import zipfile

OCTAHEDRON = [1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1]


def npy(numbers, shape, dtype="<f8", code="d"):
    """An array in NumPy's format, version 1.0."""
    header = f"{{'descr': '{dtype}', 'fortran_order': False, 'shape': {shape}, }}"
    header += " " * (63 - (10 + len(header)) % 64) + "\n"
    return (b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode()
            + struct.pack(f"<{len(numbers)}{code}", *numbers))


def npz(path, **arrays):
    """A file of arrays, which are in NumPy's format already."""
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in arrays.items():
            archive.writestr(name + ".npy", content)


def make_wrong_weights(path):
    """Three targets of four sources: a sum of 1.25, a source twice, and a weight that is no number."""
    header = "{'descr': '|S3', 'fortran_order': False, 'shape': (), }"
    header += " " * (63 - (10 + len(header)) % 64) + "\n"
    npz(path, indices=npy([0, 1, 2, 2, 3], (5,), "<i4", "i"), indptr=npy([0, 2, 4, 5], (4,), "<i8", "q"),
        format=b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode() + b"csr",
        shape=npy([3, 4], (2,), "<i8", "q"), data=npy([0.5, 0.75, 0.5, 0.5, math.nan], (5,)))


def make(directory):
    """Writes the files into `directory`."""
    whole = npy(OCTAHEDRON, (6, 3))
    with_nan = OCTAHEDRON[:7] + [math.nan] + OCTAHEDRON[8:]
    polar = [0, 90, 0, -90, 10, 0, 100, 0, 190, 95, 280, 0]
    for name, content in {
            "octahedron.npy": whole,
            "lonlat.npy": npy([0, 90, 0, -90, 10, 0, 100, 0, 190, 0, 280, 0], (6, 2)),
            "latitude-95.npy": npy(polar, (6, 2)),
            "nan.npy": npy(with_nan, (6, 3)),
            "truncated.npy": whole[:-5],
            "truncated-header.npy": whole[:30],
            "float32.npy": npy(OCTAHEDRON, (6, 3), "<f4", "f"),
            "integers.npy": npy(OCTAHEDRON, (6, 3), "<i8", "q"),
            "four-columns.npy": npy([1.0] * 8, (2, 4)),
            "no-rows.npy": npy([], (0, 3)),
            "text.npy": b"x,y,z\n1,0,0\n",
            "empty.npy": b"",
            "empty.csv": b"",
            "bom.csv": "\ufefflon,lat,name\r\n0,0,\"A, \u00e9\"\r\n90,0,B\r\n0,90,C\r\n".encode(),
            "no-faces.npy": npy([], (0, 3), "<u4", "I"),
            "corner-9.npy": npy([0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4,
                                 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 9], (8, 3), "<u4", "I"),
            "inside-out.npy": npy([2, 0, 4, 1, 2, 4, 3, 1, 4, 0, 3, 4,
                                   0, 2, 5, 2, 1, 5, 1, 3, 5, 3, 0, 5], (8, 3), "<u4", "I"),
            "open.npy": npy([0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4,
                             2, 0, 5, 1, 2, 5, 3, 1, 5], (7, 3), "<u4", "I"),
            "triangles.npy": npy([0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4,
                                  2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5], (8, 3), "<u4", "I"),
    }.items():
        (directory / name).write_bytes(content)
    make_wrong_weights(directory / "wrong.npz")
    (directory / "folder").mkdir()
    (directory / "folder.npy").mkdir()
    for ending in ("npy", "geojson", "png", "csv", "nc", "exo"):
        os.symlink("/dev/full", directory / f"full-disk.{ending}")


def read_faces(path):
    """The rows of an (m, 3) uint32 array."""
    with open(path, "rb") as file:
        content = file.read()
    start = 10 + struct.unpack_from("<H", content, 8)[0]
    return [list(face) for face in struct.iter_unpack("<3I", content[start:])]


def flip_diagonal(source, target):
    """Copies triangles, with the first diagonal flipped whose new edge is not yet there."""
    faces = read_faces(source)
    edges = {(face[i], face[(i + 1) % 3]): (f, face[(i + 2) % 3])
             for f, face in enumerate(faces) for i in range(3)}
    for (a, b), (f, c) in edges.items():
        g, d = edges[b, a]
        if (c, d) not in edges:
            faces[f], faces[g] = [a, d, c], [d, b, c]
            break
    corners = [corner for face in faces for corner in face]
    with open(target, "wb") as file:
        file.write(npy(corners, (len(faces), 3), "<u4", "I"))
