#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""No command writes a file that it reads, nor one file twice, under whatever spelling and whichever option names it.

The table below has every file that a command reads or writes; the test fails if the help of a command has one that is not there.
"""

import os
import pathlib
import re
import unittest

from tool_in_folder import ToolInFolder

# The arguments of each command, in which {OPTION} stands for a file, and the files that it reads and writes: their ending where they
# are one. Options that are left out are not needed.
COMMANDS = {
    "delaunay": (
        "{INPUT}",
        ["INPUT"],
        {
            "--output": ".npy",
            "--neighbors": ".npy",
            "--areas": ".npy",
            "--circumcenters": ".npy",
            "--duplicates": ".npy",
        },
    ),
    "triangulate": ("{INPUT} --constraints {--constraints}", ["INPUT", "--constraints"], {"--output": ".npy"}),
    "voronoi": ("{INPUT}", ["INPUT", "--clip"], {"--output": ".geojson"}),
    "regions": ("{INPUT} --clip {--clip}", ["INPUT", "--clip"], {"--output": ".geojson"}),
    "overlay": ("{INPUT} {SECOND}", ["INPUT", "SECOND"], {"--output": ".geojson"}),
    "repair": ("{INPUT}", ["INPUT"], {"--output": ".geojson"}),
    "relate": ("{INPUT} {SECOND}", ["INPUT", "SECOND"], {"--output": ".csv"}),
    "simplify": ("{INPUT} --tolerance 1", ["INPUT"], {"--output": ".geojson"}),
    "buffer": ("{INPUT} --distance 1", ["INPUT"], {"--output": ".geojson"}),
    "hull": ("{INPUT}", ["INPUT"], {"--output": ".npy"}),
    "check": ("{INPUT} {TRIANGLES}", ["INPUT", "TRIANGLES"], {}),
    "contours": (
        "{INPUT} --value v --step 1 --method native --source {--source}",
        ["INPUT", "--source"],
        {"--output": ".geojson"},
    ),
    "graph": ("{INPUT} --kind gabriel", ["INPUT"], {"--output": ".geojson"}),
    "plot": ("{INPUT}", ["INPUT"], {"--output": ".svg"}),
    "generate": ("uniform -n 5", [], {"--output": ".csv"}),
    "info": ("{INPUT}", ["INPUT"], {}),
    "completion": ("bash", [], {}),
    "locate": ("{INPUT} {QUERIES}", ["INPUT", "QUERIES"], {"--output": ".csv"}),
    "nearest": ("{INPUT} {QUERIES}", ["INPUT", "QUERIES"], {"--output": ".csv"}),
    "interpolate": (
        "{INPUT} --value v --to {--to}",
        ["INPUT", "--to", "--constraints", "--source"],
        {"--output": ".nc", "--weights": ".nc"},
    ),
    "regrid": ("{INPUT} {TARGET}", ["INPUT", "TARGET"], {"--output": ".nc"}),
    "remap": ("{INPUT} {TARGET}", ["INPUT", "TARGET"], {"--output": ".nc"}),
    "apply": ("{WEIGHTS} {VALUES}", ["WEIGHTS", "VALUES"], {"--output": ".nc"}),
    "check-weights": ("{WEIGHTS}", ["WEIGHTS"], {}),
    "mesh scvt": (
        "-n 12 --spacing {--spacing}",
        ["--spacing", "--refine", "--density", "--fixed", "--along", "--start"],
        {"--output": ".nc", "--graph": "", "--report": ""},
    ),
    "mesh triangles": (
        "--spacing {--spacing}",
        ["--spacing", "--refine", "--coast", "--area", "--lines", "--depth", "--elevation"],
        {"--output": ".nc", "--report": ""},
    ),
    "mesh icosahedral": ("1", [], {"--output": ".nc", "--graph": "", "--report": ""}),
    "mesh points": (
        "poisson --radius 3000",
        [],
        {"--output": ".nc", "--graph": "", "--report": ""},
    ),
    "mesh equal-area": ("{INPUT}", ["INPUT"], {"--output": ".npy"}),
    "mesh convert": ("{INPUT}", ["INPUT"], {"--output": ".nc", "--graph": "", "--report": ""}),
    "mesh cull": (
        "{INPUT} --mask {--mask}",
        ["INPUT", "--inside", "--outside", "--mask"],
        {
            "--output": ".nc",
            "--graph": "",
            "--report": "",
            "--cell-map": ".npy",
            "--edge-map": ".npy",
            "--vertex-map": ".npy",
        },
    ),
    "mesh quality": ("{INPUT}", ["INPUT"], {"--report": ""}),
}
# Options that exclude those which the arguments above have.
INSTEAD = {"--density": "-n 12", "--start": ""}
# Files that are told apart elsewhere: a folder of the command's own.
APART = {"delaunay": {"--scratch"}}
FILE = re.compile(r"^  (?:-\w,)?(--[\w-]+)(?:,--[\w-]+)? (FILE|TARGET|KM\|FILE|FILE:KM|DIR)\b")
ARGUMENT = re.compile(r"^  (INPUT|SECOND|TRIANGLES|QUERIES|TARGET|WEIGHTS|VALUES)\b")


class SeparateFiles(ToolInFolder):
    def setUp(self):
        super().setUp()
        (self.folder / "sub").mkdir()

    def spellings(self, name):
        """The file under other names; a link and a second name of it are made."""
        for link in ("link", "second"):
            (self.folder / (link + pathlib.Path(name).suffix)).unlink(missing_ok=True)
        suffix = pathlib.Path(name).suffix
        os.symlink(name, self.folder / f"link{suffix}")
        yield from (name, f"./{name}", f"sub/..//{name}", str(self.folder / name), f"link{suffix}")
        if (self.folder / name).exists():
            os.link(self.folder / name, self.folder / f"second{suffix}")
            yield f"second{suffix}"

    def arguments(self, command, given):
        """The words of a command whose files are `given`; others have names of their own."""
        template = COMMANDS[command][0]
        for option, instead in INSTEAD.items():
            if option in given:
                template = instead
        if "--refine" in given:
            template = "--spacing 2000"
        words = command.split()
        for word in template.split():
            name = word[1:-1]
            words.append(given.get(name, f"other-{name.strip('-')}") if word[0] == "{" else word)
        if "--output" in COMMANDS[command][2] and "--output" not in given:
            given = {**given, "--output": f"out{COMMANDS[command][2]['--output']}"}
        for option, name in given.items():
            if option.startswith("--") and "{" + option + "}" not in template:
                words += [option, name]
        return words

    def assert_refused(self, words, said, status=2):
        content = {p: p.read_bytes() for p in self.folder.rglob("*") if p.is_file()}
        done = self.tool(*words)
        self.assertEqual((done.returncode, done.stdout), (status, ""), (words, done.stderr))
        self.assertIn(said, done.stderr, words)
        self.assertEqual(
            content, {p: p.read_bytes() for p in self.folder.rglob("*") if p.is_file()}, words
        )

    def test_every_file_of_every_command_is_in_the_table(self):
        def commands(*group):
            found = re.search(
                r"Commands[^\n]*:\n(.*?)\n\n'rondel ", self.tool(*group, "--help").stdout, re.S
            )
            names = re.findall(r"^  ([\w-]+) ", found[1], re.M)
            return [" ".join((*group, name)) for name in names if (*group, name) != ("mesh",)]

        every = commands() + commands("mesh")
        self.assertEqual(sorted(every), sorted(COMMANDS))
        for command in every:
            lines = self.tool(*command.split(), "--help").stdout.splitlines()
            found = {m[1] for line in lines if (m := FILE.match(line) or ARGUMENT.match(line))}
            _, read, written = COMMANDS[command]
            self.assertEqual(found, {*read, *written, *APART.get(command, ())}, command)

    def test_no_output_is_an_input(self):
        for command, (_, read, written) in COMMANDS.items():
            for source in read:
                for output, ending in written.items():
                    name = f"same{ending}"
                    (self.folder / name).write_bytes(b"content")
                    part = {"--refine": ":30"}.get(source, "")
                    what = (
                        "the input" if source in ("INPUT", "WEIGHTS") else f"the file of {source}"
                    )
                    for spelling in self.spellings(name):
                        words = self.arguments(command, {source: name + part, output: spelling})
                        self.assert_refused(words, f"{output}: '{spelling}' is {what}")
                    for variable in (":t", ":a:b"):
                        if source == "--refine":
                            continue
                        words = self.arguments(command, {source: name + variable, output: name})
                        self.assert_refused(words, f"{output}: '{name}' is {what}")
                    (self.folder / name).unlink()

    def test_no_two_outputs_are_one_file(self):
        for command, (_, _, written) in COMMANDS.items():
            for first in written:
                for second in list(written)[: list(written).index(first)]:
                    endings = {written[first], written[second]} - {""}
                    name = f"same{min(endings, default='')}"
                    if len(endings) > 1:
                        continue  # the names differ
                    for exists in (False, True):
                        if exists:
                            (self.folder / name).write_bytes(b"content")
                        for spelling in self.spellings(name):
                            words = self.arguments(command, {second: name, first: spelling})
                            self.assert_refused(words, "' is the file of --")
                        (self.folder / name).unlink(missing_ok=True)

    def test_only_output_is_standard_output(self):
        for command, (_, _, written) in COMMANDS.items():
            for option in set(written) - {"--output"}:
                for name in ("-", "/dev/stdout", "/dev/fd/1"):
                    words = self.arguments(command, {option: name})
                    self.assert_refused(words, f"{option}: only --output may be standard output")

    def test_folders_of_all_outputs_are_there_before_one_is_written(self):
        """The other outputs could be written, and nothing is read: no INPUT exists."""
        (self.folder / "file").write_bytes(b"content")
        for command, (_, _, written) in COMMANDS.items():
            for option, ending in written.items():
                name = f"nowhere/out{ending}"
                words = self.arguments(command, {option: name})
                self.assert_refused(words, f"{name}: No such file or directory", status=1)
                name = f"file/out{ending}"
                words = self.arguments(command, {option: name})
                self.assert_refused(words, f"{name}: Not a directory", status=1)

    def test_all_outputs_appear_or_none_does(self):
        """Whichever of them cannot be written: it is a folder."""
        sites = "lon,lat,v\n0,0,1\n90,5,2\n180,0,3\n-90,0,4\n0,80,5\n3,-70,6\n"
        (self.folder / "s.csv").write_text(sites)
        (self.folder / "m.csv").write_text("m\n" + "0\n" * 6)
        read = {"INPUT": "s.csv", "--to": "grid:90", "--mask": "m.csv:m", "--spacing": "6000"}
        for command, (template, _, written) in COMMANDS.items():
            if len(written) < 2:
                continue
            given = {name: file for name, file in read.items() if f"{{{name}}}" in template}
            given |= {option: f"{option.strip('-')}{end}" for option, end in written.items()}
            for option, ending in written.items():
                (self.folder / f"folder{ending}").mkdir(exist_ok=True)
                words = self.arguments(command, {**given, option: f"folder{ending}"})
                self.assert_refused(words, f"folder{ending}: Is a directory", status=1)
            self.assertEqual(self.tool(*self.arguments(command, given)).returncode, 0, command)
            for option, name in given.items():
                if option in written:
                    (self.folder / name).unlink()

    def test_formats_are_checked_before_anything_is_written(self):
        for option, value, said in (
            ("--weights", "w.csv", "--weights: the ending of 'w.csv' is not one of .nc .nc4 .npz"),
            ("--weights", "w.npz --weight-format x", "--weight-format: 'x' is not one of"),
            ("--kind", "cdf5 --weights w.nc4", "--kind: cdf5 contradicts 'w.nc4', netCDF-4"),
        ):
            words = f"interpolate s.csv --value v --to grid:90 -o x.csv {option} {value}"
            self.assert_refused(words.split(), said)

    def test_different_files_are_none(self):
        """A second name of nothing, names that begin as others do, a device for several outputs."""
        self.assertEqual(
            self.tool("generate", "uniform", "-n", "20", "-o", "s.csv").returncode, 0
        )
        for words in (
            ("mesh", "convert", "s.csv", "-o", "s.nc", "--graph", "s", "--report", "s.c"),
            (
                "mesh",
                "convert",
                "s.csv",
                "-o",
                "m.nc",
                "--graph",
                "/dev/null",
                "--report",
                "/dev/null",
            ),
        ):
            done = self.tool(*words)
            self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
