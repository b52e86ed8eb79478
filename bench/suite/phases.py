# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Where the time of a bulk build goes: what Valgrind counts, by phase.

Valgrind runs phases_bench, compiled with line numbers, and counts instructions, mispredicted
branches and missed lines of caches in delaunay() alone. Each build has an input of its own. The
phase is found by the function, or by the file of what was compiled into it. The caches are those
that Valgrind simulates: 32 KiB, and the last level as given; it knows vectors of 256 bits, not of
512.
"""

import argparse
import collections
import pathlib
import re
import subprocess
import sys
import tempfile

from .settings import ROOT
from .tables import Table, number, power

# The first that is found in "file function" names the phase.
PHASES = (
    ("order", r"/order/|rondel::order::"),
    ("coordinates", r"SquareSites<[^>]*>::(enter|find_bounds|limits)|::find_directions|directions"),
    ("leaves", r"/leaves\.|/leaf_plan\.h|/few_sites\.h|draw_leaf|find_leaf_faces"),
    ("exact decisions", r"/predicates/|/exact/|rondel::predicates::|rondel::exact::|/models/"
                        r"|SquareSites<[^>]*>::(is_in_conflict|orientation|side_over_tangent|filtered)"),
    ("writing", r"/emit\.|Emission<|emit_faces|SphereTriangulation<[^>]*>::write"),
    ("seam, stitch", r"/(stitch|seam_faces|seam_tree|open_faces|square_seam|square_piece|certificate)"
                     r"\.|rondel::bulk::(stitch|SeamFaces|find_open)"),
    ("splits, merges", r"/(divide|merge|merge_step|plane_graph|closing|square_sites|given_sites)\."
                       r"(h|cpp)|rondel::bulk::(Divide|Merge|Closing|PlaneGraph|Piece)"),
    ("memory", r"(?:^|[ /])(_int_|malloc|free|mem(set|move|cpy)|operator (new|delete)|__mem|munmap|mmap)"
               r"|memset|memmove|memcpy"),
)
OTHER = "sphere, validation, the rest"
EVENTS = ("Ir", "Bcm", "Bim", "D1mr", "D1mw", "DLmr", "DLmw")


def phase_of(file, function):
    """By file, then by function; the arithmetic that is compiled into merges is theirs."""
    if re.search(r"Merge<.*>::(sew|find_tangent)", function):
        return "splits, merges"
    if "triangulate_sphere" in function and "/order/" not in file:
        return OTHER
    for words in (f"{file} ", f" {function}"):
        for name, pattern in PHASES:
            if re.search(pattern, words):
                return name
    return OTHER


def _name(names, text):
    """Callgrind writes "(number) name" once and "(number)" from then on."""
    number_of, _, name = text.partition(" ")
    if name:
        names[number_of] = name
    return names.get(number_of, text)


def read_costs(lines):
    """{(file, function): {event: count}} of a file that Callgrind wrote, calls excluded."""
    files, functions = {}, {}
    events, file, function, is_call = [], "", "", False
    costs = collections.defaultdict(collections.Counter)
    for line in lines:
        key, is_assignment, value = line.rstrip("\n").partition("=")
        if line.startswith("events:"):
            events = line.split()[1:]
        elif is_assignment and key in ("fl", "fi", "fe"):
            file = _name(files, value)
        elif is_assignment and key == "fn":
            function = _name(functions, value)
        elif is_assignment and key in ("cfi", "cfl"):
            _name(files, value)
        elif is_assignment and key == "cfn":
            _name(functions, value)
        elif is_assignment and key == "calls":
            is_call = True
        elif line[:1].isdigit() or line[:1] in ("+", "-", "*"):
            if not is_call:
                for event, count in zip(events, line.split()[1:], strict=False):
                    costs[file, function][event] += int(count)
            is_call = False
    return costs


def count(program, kind, sites, builds, words, last_level):
    """{(file, function): {event: count}}"""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "callgrind.out"
        command = ["valgrind", "--tool=callgrind", "--branch-sim=yes", "--cache-sim=yes",
                   f"--LL={last_level},16,64", "--toggle-collect=rondel::delaunay(*",
                   f"--callgrind-out-file={out}", program, kind, sites, builds, *words]
        done = subprocess.run([str(word) for word in command], check=False, capture_output=True,
                              text=True)
        if done.returncode != 0:
            raise SystemExit(f"{program}: {done.stderr.strip()}")
        with open(out, encoding="utf-8") as file:
            return read_costs(file)


def by_phase(costs):
    phases = collections.defaultdict(collections.Counter)
    for (file, function), events in costs.items():
        phases[phase_of(file, function)].update(events)
    return phases


def table_of(kind, sites, builds, phases):
    total = collections.Counter()
    for events in phases.values():
        total.update(events)
    def row(name, events):
        share = number(100 * events["Ir"] / max(total["Ir"], 1))
        counts = (events["Ir"], events["Bcm"] + events["Bim"], events["D1mr"] + events["D1mw"],
                  events["DLmr"] + events["DLmw"])
        return [name, *(number(n / (sites * builds)) for n in counts), share]
    names = [name for name, _ in PHASES] + [OTHER]
    rows = [row(name, phases[name]) for name in names if name in phases]
    return Table(f"{kind}, {power(sites)} sites, {builds} builds: a site",
                 ["phase", "instructions", "mispredicted", "L1 misses", "last-level misses",
                  "% of instructions"], [*rows, row("all", total)])


def build_program(folder):
    """Release with line numbers, which change no instruction."""
    for command in (["cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                     "-DCMAKE_CXX_FLAGS_RELEASE=-O3 -DNDEBUG -g1", "-DRONDEL_BUILD_BENCHMARKS=ON",
                     "-DRONDEL_BUILD_TOOL=OFF"],
                    ["cmake", "--build", folder, "--target", "phases_bench"]):
        subprocess.run([str(word) for word in command], check=True, stdout=subprocess.DEVNULL)
    return folder / "bin" / "phases_bench"


def parse(words):
    parser = argparse.ArgumentParser(prog="scripts/bench --phases", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kinds", nargs="+", default=["uniform"], help="of inputs/kinds.h")
    parser.add_argument("--log2", nargs="+", type=int, default=[10, 14, 20])
    parser.add_argument("--model", choices=("projected", "weighted"), default="projected")
    parser.add_argument("--last-level", type=int, default=1 << 20,
                        help="bytes of the last cache that is simulated (1 MiB)")
    parser.add_argument("--program", type=pathlib.Path, help="phases_bench, instead of a new build")
    parser.add_argument("--functions", type=int, default=0, help="list so many functions, too")
    return parser.parse_args(words)


def main(words):
    arguments = parse(words)
    program = arguments.program or build_program(ROOT / "build" / "phases")
    for kind in arguments.kinds:
        for log2 in arguments.log2:
            sites = 2**log2
            builds = max(1, 2**16 // sites)
            costs = count(program, kind, sites, builds, [arguments.model], arguments.last_level)
            print(table_of(kind, sites, builds, by_phase(costs)).markdown(), flush=True)
            largest = sorted(costs.items(), key=lambda item: -item[1]["Ir"])
            for (file, function), events in largest[:arguments.functions]:
                print(number(events["Ir"] / (sites * builds)),
                      number((events["Bcm"] + events["Bim"]) / (sites * builds)),
                      phase_of(file, function), file, function, sep=" | ")


if __name__ == "__main__":
    main(sys.argv[1:])
