# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The reference of the npm package as Markdown, by TypeDoc: javascript.py NODE_MODULES_FOLDER PACKAGE FOLDER"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
TITLES = {
    "index": "The module rondel",
    "d3/index": "The module rondel/d3",
    "worker/index": "The module rondel/worker",
    "surface/index": "The module rondel/surface",
}


def main(modules, package, folder):
    types = package / "types"
    settings = {
        "compilerOptions": {"target": "es2022", "module": "nodenext", "lib": ["es2023", "dom"], "skipLibCheck": True, "types": []},
        "include": [str(types)],
    }
    with tempfile.TemporaryDirectory() as scratch:
        config = pathlib.Path(scratch, "tsconfig.json")
        config.write_text(json.dumps(settings), encoding="utf-8")
        subprocess.run(
            ["node", modules / "node_modules/typedoc/bin/typedoc", "--options", HERE / "typedoc.json", "--tsconfig", config,
             "--logLevel", "Error", "--out", folder, *(types / f"{name}.d.ts" for name in TITLES)],
            check=True,
            cwd=modules,
        )
    for name in TITLES:
        module = folder / pathlib.Path(name).parent if "/" in name else folder / "index"
        index = module / "index.md"
        text = re.sub(r"^# .*", f"# {TITLES[name]}", index.read_text(encoding="utf-8"), count=1)
        beside = sorted(path.relative_to(module).with_suffix("").as_posix() for path in module.glob("*/*.md"))
        listed = "\n```{toctree}\n:hidden:\n\n" + "\n".join(beside) + "\n```\n" if beside else ""
        index.write_text(text + listed, encoding="utf-8")
    (folder / "index.md").write_text(
        "# JavaScript\n\nThe npm package `rondel`, from its types; [the guide](/docs/guide/javascript.md) shows how the parts go together.\n\n"
        "```{toctree}\n:maxdepth: 1\n\nindex/index\nd3/index\nworker/index\nsurface/index\n```\n",
        encoding="utf-8",
    )


if __name__ == "__main__":
    main(*(pathlib.Path(argument).resolve() for argument in sys.argv[1:]))
