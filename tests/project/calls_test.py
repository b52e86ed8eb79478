# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""A layer calls itself and lower layers alone, by way of public headers too (calls_test.py LAYERS OBJECTS NM).

OBJECTS lists the object files of the libraries, one a line. Functions of public types, which are in the layer api, may be called
by all layers, for all have these types.
"""

import pathlib
import re
import subprocess
import sys

STRONG = "TDBR"  # kinds of symbols that one object alone defines


def layer_of(path, layers):
    """The layer of an object file, compiled alone or with its neighbors; None if it has none."""
    if "rondel_distributed.dir" in path:
        return "distributed"
    found = re.search(r"\.dir/(?:\./)?(?:Unity/unity_(\w+?)_cxx|(\w+)/)", path)
    layer = found and (found.group(1) or found.group(2))
    return layer if layer in layers else None


def symbols_of(path, nm):
    """The symbols that an object defines, and those that it uses."""
    lines = subprocess.run([nm, "-P", path], capture_output=True, text=True, check=True).stdout.splitlines()
    kinds = [line.split()[:2] for line in lines]
    return {name for name, kind in kinds if kind in STRONG}, {name for name, kind in kinds if kind == "U"}


def main():
    layers = pathlib.Path(sys.argv[1]).read_text(encoding="utf-8").split()
    objects = pathlib.Path(sys.argv[2]).read_text(encoding="utf-8").split()
    nm = sys.argv[3]
    defined, used = {}, {}
    for path in objects:
        layer = layer_of(path, layers)
        if layer is None:
            sys.exit(f"{path} is of no layer")
        defines, uses = symbols_of(path, nm)
        defined.update(dict.fromkeys(defines, layer))
        used.setdefault(layer, set()).update(uses)
    upward = sorted(
        f"{layer} calls {name} of {defined[name]}"
        for layer, names in used.items()
        for name in names
        if defined.get(name, "api") != "api" and layers.index(defined[name]) > layers.index(layer)
    )
    if len(used) < len(layers) / 2:
        sys.exit(f"only {len(used)} layers have objects")
    names = subprocess.run(["c++filt"], input="\n".join(upward), capture_output=True, text=True, check=True).stdout
    print(names or f"{len(defined)} symbols: every call goes down")
    return 1 if upward else 0


if __name__ == "__main__":
    sys.exit(main())
