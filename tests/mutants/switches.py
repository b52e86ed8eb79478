# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Many changes in one build, each behind a switch (mutant schemata, Untch 1993).

The smallest expression around a change, which libclang finds, becomes `(rondel_mutant(7) ? changed : expression)`. The
function is true for the number that the variable RONDEL_MUTANT of the environment names, and notes each number that it is
asked for in the file that RONDEL_REACHED names. The changed expression stands on one line and has no other switches, so
that lines keep their numbers and the text stays short.
"""

import json
import re
import shlex

import clang.cindex
from clang.cindex import CursorKind

FUNCTIONS = {CursorKind.FUNCTION_DECL, CursorKind.CXX_METHOD, CursorKind.FUNCTION_TEMPLATE, CursorKind.CONSTRUCTOR,
             CursorKind.CONVERSION_FUNCTION}
VARIABLES = {CursorKind.VAR_DECL}
DECLARATION = b"bool rondel_mutant(int number) noexcept; "
# Atomic, as threads ask at the same time; a file in memory, as tests start processes and end without ado.
DEFINITION = rb"""
#include <fcntl.h>
#include <sys/mman.h>

#include <unistd.h>

#include <atomic>
#include <cstdlib>

// Closes the file again, as a program without standard input would take it for that.
static void* mapped(const char* name) noexcept {
  const int file = open(name, O_RDWR);
  void* const result = mmap(nullptr, %d, PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  return result;
}

bool rondel_mutant(int number) noexcept {
  static const char* const chosen = std::getenv("RONDEL_MUTANT");
  static const int active = chosen == nullptr ? -1 : std::atoi(chosen);
  static const char* const name = std::getenv("RONDEL_REACHED");
  static void* const file = name == nullptr ? nullptr : mapped(name);
  if (file != nullptr && file != MAP_FAILED) {
    std::atomic_ref(static_cast<char*>(file)[number]).store(1, std::memory_order_relaxed);
  }
  return number == active;
}
"""


class Source:
    """A file with the places in it that libclang understands; offsets are of bytes."""

    def __init__(self, path, texts, arguments):
        """`path` is where the compiler finds it, `texts` are those of the layer before any change, {path: text}."""
        self.text = texts[path].encode("latin-1")
        self.unit = clang.cindex.Index.create().parse(path, arguments, list(texts.items()))
        self.top = [c for c in self.unit.cursor.get_children()
                    if c.location.file is not None and c.location.file.name == path]

    def path_to(self, begin, end):
        """The cursors around [begin, end), from the outermost to the innermost."""
        path = []
        nodes = self.top
        while nodes:
            nodes = [n for n in nodes if n.extent.start.offset <= begin and n.extent.end.offset >= end]
            if not nodes:
                break
            path.append(nodes[0])
            nodes = list(nodes[0].get_children())
        return path

    def switched_range(self, begin, end, new):
        """[begin, end) of the expression that a switch replaces for a change there, None if there is none."""
        old = self.text[begin:end]
        if old in (b"break", b"continue"):
            return begin, end + 1  # with the semicolon
        if re.fullmatch(rb"\d[\w.-]*|true|false", old):
            return begin, end
        is_call = re.fullmatch(rb"\w+", old) is not None
        is_unary = new == ""
        for cursor in reversed(self.path_to(begin, end)):
            first, last = cursor.extent.start.offset, cursor.extent.end.offset
            if (cursor.kind.is_expression() and cursor.kind != CursorKind.INIT_LIST_EXPR and last > end
                    and (first <= begin if is_call or is_unary else first < begin)):
                return first, last
        return None

    def constant_words(self, begin, end):
        """Replacements of the words that ask the compiler for a constant around a change, [(begin, end, new)]."""
        result = []
        for cursor in self.path_to(begin, end):
            if cursor.kind not in VARIABLES | FUNCTIONS:
                continue
            start = cursor.extent.start.offset
            head = re.search(rb"constexpr\b", re.split(rb"[({=]", self.text[start:begin], maxsplit=1)[0])
            if head is not None:
                new = b"inline" if cursor.kind in FUNCTIONS else b"const"
                if b"static" in self.text[start:begin].split() and cursor.semantic_parent.kind not in FUNCTIONS:
                    new = b"inline " + new if cursor.kind in VARIABLES else new
                result.append((start + head.start(), start + head.end(), new))
        return result


def in_one_line(text):
    """A text of code without its comments and line breaks."""
    return re.sub(rb"\s*\n\s*", b" ", re.sub(rb"//[^\n]*", b"", text))


def rendered(text, begin, end, edits):
    """text[begin:end] with edits [(first, last, before, after)], the outer of two first: what stands in [first, last) comes
    between `before` and `after`, with the edits in it, or is replaced by `before` where `after` is None."""
    result = b""
    while edits:
        (first, last, before, after), *edits = edits
        inner = [edit for edit in edits if edit[0] < last]
        edits = edits[len(inner):]
        result += text[begin:first] + before
        if after is not None:
            result += rendered(text, first, last, inner) + after
        begin = last
    return result + text[begin:end]


def switched(source, changes):
    """A source with changes {number: (begin, end, new)} behind switches."""
    edits = set()
    text = source.text
    for number, (begin, end, new) in changes.items():
        first, last = source.switched_range(begin, end, new)
        changed = in_one_line(text[first:begin] + new.encode() + text[end:last])
        asked = b"rondel_mutant(%d)" % number
        if text[begin:end] in (b"break", b"continue"):
            edits.add((first, last, b"{ if (" + asked + b") " + changed + b" ", b" }"))
        else:
            edits.add((first, last, b"(" + asked + b" ? " + changed + b" : ", b")"))
        edits |= {(b, e, word, None) for b, e, word in source.constant_words(begin, end)}
    return DECLARATION + rendered(text, 0, len(text), sorted(edits, key=lambda edit: (edit[0], -edit[1], edit[2])))


def compiler_arguments(build, layer):
    """What libclang needs to understand the files of a layer: what their compiler is told in a build."""
    with open(build / "compile_commands.json", encoding="utf-8") as file:
        commands = [command["command"] for command in json.load(file) if f"/src/{layer}/" in command["file"]]
    words = {word: None for command in commands for word in shlex.split(command)}
    return ["-xc++", "-ferror-limit=0", *(word for word in words if word.startswith(("-I", "-D", "-std=")))]


def refused(message, layer, spans):
    """The numbers of the changes that a compiler refuses: those on the lines of its errors, or else, as an error may be
    reported where a template is used, on all lines that it mentions, or else, as a constant is computed elsewhere, in the
    files of its errors; `spans` has (file, first line, last line) by number."""
    for pattern in (r"error:", r""):
        lines = {(file, int(line)) for file, line in
                 re.findall(rf"\b(src/{layer}/[\w.]+):(\d+):[^\n]*{pattern}", message)}
        numbers = {number for number, (file, first, last) in spans.items()
                   if any(f == file and first <= line <= last for f, line in lines)}
        if numbers:
            return numbers
    files = set(re.findall(rf"\b(src/{layer}/[\w.]+):\d+:[^\n]*error:", message))
    return {number for number, (file, _, _) in spans.items() if file in files}
