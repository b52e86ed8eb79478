#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Shells complete what the help pages name: each command, each option, and names of files where one is meant.

    completion_test.py TOOL

bash answers itself; zsh and fish, too, where they are installed.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

TOOL = pathlib.Path(sys.argv.pop(1)).resolve()


def help_of(command):
    return subprocess.run([TOOL, *command, "--help"], text=True, capture_output=True, check=True).stdout


def commands_in(text):
    found = re.findall(r"^Commands[^\n]*:\n((?:  .*\n?)+)", text, re.M)
    return re.findall(r"^  ([\w-]+)", "".join(found), re.M)


def every_command(command=()):
    """The tool and all commands below it, by their words."""
    yield command
    for name in commands_in(help_of(command)):
        yield from every_command((*command, name))


def options_in(text):
    """The names of the options of a help page."""
    lines = re.findall(r"^  (-[^ ]+)", text, re.M)
    return {name for line in lines for name in line.split(",")}


class Shells(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.environment = {**os.environ, "PATH": f"{TOOL.parent}:{os.environ['PATH']}", "HOME": folder.name}
        (self.folder / "a file.csv").write_text("")
        (self.folder / "ab.nc").write_text("")

    def run_shell(self, *words):
        done = subprocess.run(words, cwd=self.folder, env=self.environment, text=True, capture_output=True, timeout=120, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""), words)
        return done.stdout

    def script(self, shell):
        path = self.folder / f"script.{shell}"
        path.write_text(self.run_shell("rondel", "completion", shell))
        return path

    def bash(self, lines):
        """What bash offers for the last word of each command line."""
        asked = "".join(
            f"COMP_WORDS=({' '.join(repr(word) for word in line)}); COMP_CWORD={len(line) - 1}; "
            "_rondel; printf '%s|' \"${COMPREPLY[@]}\"; echo\n"
            for line in lines
        )
        output = self.run_shell("bash", "--norc", "-c", f"source {self.script('bash')}\n{asked}")
        return [set(line.split("|")) - {""} for line in output.splitlines()]

    def test_bash_offers_what_the_help_names(self):
        commands = list(every_command())
        self.assertGreater(len(commands), 30)
        answers = self.bash([["rondel", *command, "-"] for command in commands])
        for command, answer in zip(commands, answers, strict=True):
            self.assertEqual(answer, options_in(help_of(command)), command)
        groups = [command for command in commands if commands_in(help_of(command))]
        for command, answer in zip(groups, self.bash([["rondel", *command, ""] for command in groups]), strict=True):
            self.assertLessEqual(set(commands_in(help_of(command))), answer)

    def test_bash_offers_files_where_they_belong(self):
        lines = [
            ["rondel", "vor"],
            ["rondel", "mesh", "s"],
            ["rondel", "delaunay", "a"],
            ["rondel", "delaunay", "ab.nc", "-o", "a"],
            ["rondel", "delaunay", "ab.nc", "--threads", ""],
            ["rondel", "completion", ""],
            ["rondel", "mesh", "scvt", ""],
        ]
        files = {"a file.csv", "ab.nc"}
        shells = {"bash", "zsh", "fish"}
        self.assertEqual(self.bash(lines), [{"voronoi"}, {"scvt"}, files, files, set(), shells, set()])

    def test_bash_offers_the_words_of_options(self):
        lines = [
            ["rondel", "regrid", "ab.nc", "grid:1", "--method", "c"],
            ["rondel", "remap", "--norm", ""],
            ["rondel", "delaunay", "ab.nc", "--model", ""],
            ["rondel", "plot", "ab.nc", "--show", ""],
            ["rondel", "mesh", "points", "h"],
            ["rondel", "generate", "unif"],
        ]
        wanted = [{"conservative", "conservative-2nd", "cubic"}, {"destarea", "fracarea"}, {"projected", "weighted"}]
        wanted += [{"none", "delaunay", "voronoi", "both"}, {"healpix"}, {"uniform"}]
        self.assertEqual(self.bash(lines), wanted)

    def test_words_are_those_that_the_parser_takes(self):
        """An option whose value is one of some words refuses others, and takes each of these."""
        script = self.script("bash").read_text()
        choices = re.findall(r"^    '([\w -]*)\|(--[\w-]+)'\) choices='([^']*)'", script, re.M)
        self.assertGreater(len(choices), 20)
        for command, option, words in choices:
            for word in [*words.split(), "no-such-word"]:
                done = subprocess.run([TOOL, *command.split(), option, word], text=True, capture_output=True, check=False)
                is_refused = f"{option}: 'no-such-word' is no" in done.stderr
                self.assertEqual(is_refused, word == "no-such-word", (command, option, word, done.stderr))

    @unittest.skipUnless(shutil.which("fish"), "fish is not installed")
    def test_fish_offers_what_the_help_names(self):
        script = self.script("fish")
        commands = list(every_command())
        asked = "".join(f"complete -C 'rondel {' '.join([*command, '-'])}' | cut -f1; echo ==\n" for command in commands)
        asked += "".join(f"complete -C 'rondel {' '.join([*command, '--'])}' | cut -f1; echo ==\n" for command in commands)
        output = self.run_shell("fish", "--no-config", "-c", f"source {script}\n{asked}").split("==\n")
        for command, short, long in zip(commands, output, output[len(commands):], strict=False):
            self.assertLessEqual(options_in(help_of(command)), {*short.split(), *long.split()}, command)
        offered = self.run_shell("fish", "--no-config", "-c", f"source {script}\ncomplete -C 'rondel mesh s'")
        self.assertEqual([line.split("\t")[0] for line in offered.splitlines()], ["scvt"])
        for asked, wanted in (("completion ", {"bash", "zsh", "fish"}), ("remap --norm ", {"destarea", "fracarea"})):
            offered = self.run_shell("fish", "--no-config", "-c", f"source {script}\ncomplete -C 'rondel {asked}'")
            self.assertEqual({line.split("\t")[0] for line in offered.splitlines()}, wanted)

    @unittest.skipUnless(shutil.which("zsh"), "zsh is not installed")
    def test_zsh_reads_its_script(self):
        script = self.script("zsh")
        functions = self.run_shell("zsh", "-f", "-c", f"autoload -U compinit; compinit -D; source {script}; print -l ${{(k)functions}}; print $_comps[rondel]")
        expected = {"_".join(["_rondel", *command]) for command in every_command()}
        self.assertLessEqual(expected, set(functions.splitlines()))


if __name__ == "__main__":
    unittest.main()
