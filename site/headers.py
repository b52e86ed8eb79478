# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""A public C++ header as Markdown.

What stands in the namespace is a list of blocks between blank lines, each a comment of `///` lines and what it is
about. The comment becomes text, the declaration code below a heading with its name. Members stay in the code of
their class, with their comments.
"""

import re

NAME = [
    re.compile(r"^(?:template\s*<[^>]*>\s*)?(?:struct|class|enum class|enum)\s+(?:RONDEL_API\s+)?(\w+)", re.M),
    re.compile(r"^using\s+(\w+)", re.M),
    re.compile(r"^(?:inline\s+)?constexpr\s+[\w:<>, ]+?\s(\w+)\s*(?:=|\{)", re.M),
    re.compile(r"(operator\s*\S+?|\w+)\s*\("),
]
COMMANDS = {"throw": "Throws", "throws": "Throws", "pre": "Precondition:", "param": "Parameter", "return": "Returns"}


def blocks(text):
    """The blocks of the namespace, as lists of lines."""
    inside = text.split("namespace rondel {\n", 1)[1].rsplit("}  // namespace rondel", 1)[0]
    found, block, depth = [], [], 0
    for line in inside.split("\n"):
        if not line.strip() and depth == 0:
            found, block = ([*found, block] if block else found), []
            continue
        block.append(line)
        code = re.sub(r"//.*", "", line)
        depth += code.count("{") - code.count("}")
    return [*found, block] if block else found


def prose(lines):
    """The text of a comment."""
    text = "\n".join(re.sub(r"^///\s?", "", line) for line in lines)
    text = re.sub(r"\\(\w+) ", lambda match: f"\n\n**{COMMANDS[match[1]]}** " if match[1] in COMMANDS else match[0], text)
    text = re.sub(r"\n(1\. )", r"\n\n\1", text)  # a list after a sentence
    return re.sub(r"(?<!`)<(?=\w)", "&lt;", text).strip()


def name_of(code):
    for pattern in NAME:
        match = pattern.search(code)
        if match:
            return match[1]
    raise ValueError(f"no name in\n{code}")


def page(header):
    """The page of a header, given its path."""
    text = header.read_text(encoding="utf-8")
    about = re.search(r"/// \\file\n((?:///.*\n)*)", text)[1].splitlines()
    result = [f"# rondel/{header.name}", prose(about), f'```cpp\n#include "rondel/{header.name}"\n```']
    last = None
    for block in blocks(text):
        comment = []
        while block and block[0].startswith("///"):
            comment.append(block.pop(0))
        code = "\n".join(line for line in block if not line.startswith("// NOLINT"))
        if not code.strip():
            result.append(prose(comment))
            continue
        name = name_of(re.sub(r"//.*", "", code))
        if name != last:
            result.append(f"## {name}")
        last = name
        result += [prose(comment), "```cpp\n" + code.replace("RONDEL_API ", "") + "\n```"]
    return "\n\n".join(part for part in result if part) + "\n"
