# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Puts together what Sphinx reads: the documents of the repository and what is made from its sources.

    stage.py REPOSITORY FOLDER [NOTEBOOKS]

Documents keep their places below FOLDER, those of site/ lie at its top. Links from a document to a file that is
no document lead to the page that shows it; where no page does, the words stay and the link goes. Notebooks for Jupyter
are made of docs/notebooks in the folder NOTEBOOKS.
"""

import json
import pathlib
import re
import shutil
import sys

import headers

DOCUMENTS = ["docs", "bench/history", "bench/RESULTS.md", "bench/EXPERIMENTS.md", "bench/README.md", "CHANGELOG.md"]
LEXERS = {".cpp": "cpp", ".c": "c", ".txt": "cmake"}
# Folders and files that a page stands for.
PAGES = {
    "docs/theory": "/theory.md",
    "docs/decisions": "/docs/decisions/README.md",
    "docs/guide": "/docs/guide/README.md",
    "examples": "/examples/index.md",
    "include/rondel": "/reference/cpp.md",
    "include/rondel/rondel.h": "/reference/cpp.md",
    "bindings/c/include/rondel.h": "/reference/c.md",
    "bindings/js": "/docs/guide/javascript.md",
    "bindings/js/README.md": "/docs/guide/javascript.md",
    "viewer": "/docs/guide/globe.md",
}


def page_of(target, repository):
    """The page that shows a file or folder of the repository, or None."""
    if target in PAGES:
        return PAGES[target]
    page = re.fullmatch(r"site/([\w/-]+\.md)", target)
    if page:
        return f"/{page[1]}"
    header = re.fullmatch(r"include/rondel/(\w+)\.h", target)
    if header:
        return f"/reference/cpp/{header[1]}.md"
    example = re.fullmatch(r"examples/(\w+)\.(cpp|c)", target)
    if example and (repository / target).exists():
        return f"/examples/{example[1]}.md"
    return None


def with_links(text, place, repository, staged):
    """A document's text with its links mended. `place` is the document's path in the repository."""

    def mended(match):
        words, target, anchor = match["words"], match["target"], match["anchor"] or ""
        if re.match(r"[a-z]+:|/|#", target) or not target:
            return match[0]
        path = (repository / place.parent / target).resolve()
        if not path.exists():
            return match[0]
        name = path.relative_to(repository).as_posix()
        if name in staged or match["image"]:
            return match[0]
        page = page_of(name, repository)
        return f"[{words}]({page}{anchor})" if page else words

    link = r"(?P<image>!?)\[(?P<words>[^\]\n]*)\]\((?P<target>[^)#\s]*)(?P<anchor>#[^)\s]*)?\)"
    parts = re.split(r"(^```.*?^```$)", text, flags=re.M | re.S)  # code is left as it is
    return "".join(part if part.startswith("```") else re.sub(link, mended, part) for part in parts)


def with_contents(text):
    """An index whose links are also the order of the pages beside it."""
    names = re.findall(r"\]\(((?:\w[\w-]*/)?[\w-]+)\.md\)", text)
    return text + "\n```{toctree}\n:hidden:\n\n" + "\n".join(dict.fromkeys(names)) + "\n```\n"


def copy_documents(repository, folder):
    found = []
    for name in DOCUMENTS:
        path = repository / name
        found += sorted(path.rglob("*")) if path.is_dir() else [path]
    names = {path.relative_to(repository).as_posix() for path in found if path.is_file()}
    for name in sorted(names):
        source, copy = repository / name, folder / name
        copy.parent.mkdir(parents=True, exist_ok=True)
        if source.suffix != ".md":
            shutil.copyfile(source, copy)
            continue
        text = with_links(source.read_text(encoding="utf-8"), pathlib.PurePath(name), repository, names)
        if name in ("docs/guide/README.md", "docs/decisions/README.md", "docs/notebooks/README.md", "bench/README.md", "bench/history/README.md"):
            text = with_contents(text)
        elif name.startswith("docs/notebooks/"):
            text = with_download(text, source.stem)
        copy.write_text(text, encoding="utf-8")


def with_download(text, name):
    """A notebook's page, with a link below its title to the notebook for Jupyter, which notebook() makes."""
    link = f'<p><a href="../../notebooks/{name}.ipynb" download>This page as a notebook for Jupyter</a></p>'
    return re.sub(r"^(# .*\n)", rf"\1\n```{{raw}} html\n{link}\n```\n", text, count=1, flags=re.M)


def notebook(text):
    """A notebook for Jupyter of a document in MyST's format, without what its cells print."""
    body = re.sub(r"\A---\n.*?^---\n", "", text, flags=re.M | re.S)
    parts = re.split(r"^```\{code-cell\} ipython3\n(.*?)^```$", body, flags=re.M | re.S)
    cells = []
    for k, part in enumerate(parts):
        lines = part.strip("\n").splitlines(keepends=True)
        if k % 2:
            cells.append({"cell_type": "code", "metadata": {}, "execution_count": None, "outputs": [], "source": lines})
        elif lines:
            # Links between documents lead nowhere from a file of its own.
            words = [re.sub(r"\[([^\]]*)\]\((?!https?:)[^)]*\)", r"\1", line) for line in lines]
            cells.append({"cell_type": "markdown", "metadata": {}, "source": words})
    for number, cell in enumerate(cells):
        cell["id"] = f"cell-{number}"
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    return {"cells": cells, "metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 5}


def write_notebooks(repository, folder):
    """The notebooks of docs/notebooks, for Jupyter."""
    folder.mkdir(parents=True, exist_ok=True)
    for source in sorted((repository / "docs/notebooks").glob("*.md")):
        if source.stem != "README":
            text = json.dumps(notebook(source.read_text(encoding="utf-8")), indent=1, ensure_ascii=False)
            (folder / f"{source.stem}.ipynb").write_text(text + "\n", encoding="utf-8")


def pages_of_headers(repository, folder):
    """A page for each public header that declares something."""
    target = folder / "reference" / "cpp"
    target.mkdir(parents=True, exist_ok=True)
    paths = [path for path in sorted((repository / "include/rondel").glob("*.h")) if headers.NAMESPACE.search(path.read_text(encoding="utf-8"))]
    for path in paths:
        (target / f"{path.stem}.md").write_text(headers.page(path), encoding="utf-8")
    names = "\n".join(f"cpp/{path.stem}" for path in paths)
    cpp = folder / "reference" / "cpp.md"
    cpp.write_text(cpp.read_text(encoding="utf-8") + f"\n```{{toctree}}\n:maxdepth: 2\n\n{names}\n```\n", encoding="utf-8")


def pages_of_examples(repository, folder):
    """A page for each program of examples/; its first comment says what it is."""
    target = folder / "examples"
    target.mkdir(parents=True, exist_ok=True)
    programs = sorted([*(repository / "examples").glob("*.cpp"), *(repository / "examples").glob("*.c")])
    listed = ""
    for program in [*programs, repository / "examples" / "CMakeLists.txt"]:
        language = LEXERS[program.suffix]
        text = f"# {program.name}\n\n```{{literalinclude}} /examples/{program.name}\n:language: {language}\n```\n"
        shutil.copyfile(program, target / program.name)
        (target / f"{program.stem}.md").write_text(text, encoding="utf-8")
        listed += f"{program.stem}\n"
    (target / "index.md").write_text(
        "# Examples\n\nSmall programs against the installed package. The tests build and run them all, and compare what they print.\n\n"
        f"```{{toctree}}\n:maxdepth: 1\n\n{listed}```\n",
        encoding="utf-8",
    )


def page_of_measurements(repository, folder):
    """The comparison with peers in bench/RESULTS.md, below what site/measured.md says."""
    text = (repository / "bench/RESULTS.md").read_text(encoding="utf-8")
    section = re.search(r"^## Triangulations beside peers\n.*?(?=^## )", text, re.M | re.S)
    page = folder / "measured.md"
    page.write_text(page.read_text(encoding="utf-8") + section[0], encoding="utf-8")


def main(repository, folder):
    shutil.rmtree(folder, ignore_errors=True)
    tools = shutil.ignore_patterns("*.py", "*.json", "*.toml", "*.txt", "Doxyfile*", "__pycache__", "node_modules", "play")
    top = str(repository / "site")
    shutil.copytree(top, folder, ignore=lambda place, names: tools(place, names) if place == top else [])
    copy_documents(repository, folder)
    pages_of_headers(repository, folder)
    pages_of_examples(repository, folder)
    page_of_measurements(repository, folder)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve())
    if len(sys.argv) > 3:
        write_notebooks(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[3]).resolve())
