# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""A public C++ header as Markdown.

What stands in the namespace is a list of blocks between blank lines, each a comment of `///` lines and what it is
about. The comment becomes text, the declaration code below a heading with its name. Member functions have headings of
their own; fields and enumerators stay in the code of their type, with their comments. Each name is an entry of the
index, so that the search finds it, and an anchor: `triangulation-num-faces` in triangulation.html.
"""

import re

NAMESPACE = re.compile(r"^namespace rondel(?:::mesh)? \{\n", re.M)
NAME = [
    re.compile(r"^(?:template\s*<[^>]*>\s*)?(?:struct|class|enum class|enum)\s+(?:RONDEL_API\s+)?(\w+)", re.M),
    re.compile(r"^using\s+(\w+)", re.M),
    re.compile(r"^(?:inline\s+)?constexpr\s+[\w:<>,* ]+?\s(\w+)\s*(?:=|\{)", re.M),
    re.compile(r"(operator\s*\S+?|\w+)\s*\("),
]
COMMANDS = {"throw": "Throws", "throws": "Throws", "pre": "Precondition:", "param": "Parameter", "return": "Returns"}


def blocks(text):
    """The blocks of the namespace, as lists of lines."""
    inside = NAMESPACE.split(text, 1)[1].rsplit("}  // namespace rondel", 1)[0]
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


def anchor(name, key):
    """An entry of the index, and the place that it leads to."""
    return f"```{{index}} single: ! {name} (C++)\n:name: {key}\n```"


def fields_of(code):
    """The names of the fields or enumerators of a type."""
    inside = re.sub(r"//.*", "", code[code.index("{") + 1 : code.rindex("}")])
    if code.startswith("enum"):
        return re.findall(r"(\w+)\s*(?:=[^,]*)?(?:,|$)", inside.strip())
    inside = re.sub(r"\{[^{}]*\}", ";", inside)  # bodies and initial values
    found = []
    for statement in inside.split(";"):
        match = re.fullmatch(r"[^()=]*?[\w>*] ?((?:\w+, )*\w+)(?: =.*)?", statement.strip(), re.S)
        found += match[1].split(", ") if match else []
    return found


def functions_of(name, code):
    """The names in declarations of members, types among them, without what all classes have."""
    code = re.sub(r"//.*", "", code)
    found = []
    for statement in re.split(r";|(?<=\})\n", code):
        match = re.match(r"\s*using (\w+)", statement) or re.search(r"(operator\S+?|~?\w+)\s*\(", statement)
        if match and match[1] not in (f"~{name}", "operator="):
            found.append(match[1])
    return list(dict.fromkeys(found))


def functions_in(code):
    """The names of a struct's functions."""
    return re.findall(r"^  \[\[nodiscard\]\] [^(]*?(\w+)\(", code, re.M)


def members(name, code):
    """The parts of a class: lists of lines, each a comment and the declarations that it is about."""
    public = code.split(" public:\n", 1)[1].split("\n private:")[0].rsplit("};", 1)[0]
    found = [[]]
    for line in (line[2:] for line in public.split("\n")):
        is_comment = line.startswith("///")
        if not line.strip() or (is_comment and found[-1] and not found[-1][-1].startswith("///")):
            found.append([])
        if line.strip():
            found[-1].append(line)
    own = "/// For the library itself."
    return [part for part in found if part and own not in part and not re.match(r"(class|struct) \w+;", part[0])]


def pages_of_members(name, code):
    """The sections of a class's members."""
    result, seen, last = [], set(), None
    for part in members(name, code):
        comment = [line for line in part if line.startswith("///")]
        declared = "\n".join(line for line in part if not line.startswith("///"))
        names = functions_of(name, declared)
        if names and names != last:
            new = [member for member in names if member not in seen and not member.startswith("operator")]
            result += [anchor(member, f"{name}-{member}") for member in new]
            result.append(f"### {name}::{', '.join(names)}")
            seen.update(new)
        last = names or last
        result += [prose(comment), f"```cpp\n{declared.replace('RONDEL_API ', '')}\n```" if declared else ""]
    return result


def page(header):
    """The page of a header, given its path."""
    text = header.read_text(encoding="utf-8")
    about = re.search(r"/// \\file\n((?:///.*\n)*)", text)[1].splitlines()
    result = [f"# rondel/{header.name}", prose(about), f'```cpp\n#include "rondel/{header.name}"\n```']
    last, seen = None, set()
    for block in blocks(text):
        comment = []
        while block and block[0].startswith("///"):
            comment.append(block.pop(0))
        code = "\n".join(line for line in block if not line.startswith("// NOLINT"))
        if not code.strip():
            result.append(prose(comment))
            continue
        name = name_of(re.sub(r"//.*", "", code))
        code = code.replace("RONDEL_API ", "")
        kind = re.sub(r"^template\s*<[^>]*>\s*", "", code)
        if name != last:
            names = [name] if re.match(r"class|struct|enum|using|inline constexpr", kind) else functions_of("", code)
            new = [each for each in names if each not in seen]  # overloads may stand apart
            seen.update(new)
            result += [*(anchor(each, f"cpp-{header.stem}-{each}") for each in new), f"## {name}"]
        last = name
        if code.startswith("class"):
            head = code.split(" {\n", 1)[0]
            result += [prose(comment), f"```cpp\n{head};\n```", *pages_of_members(name, code)]
            continue
        fields = fields_of(kind) if re.match(r"struct|enum", kind) else []
        fields += functions_in(kind) if kind.startswith("struct") else []
        result += [prose(comment), *(anchor(field, f"{name}-{field}") for field in fields), f"```cpp\n{code}\n```"]
    return "\n\n".join(part for part in result if part) + "\n"
