"""Docstrings of scene2hap as nodes: paragraphs, lists, indented code, and `Parameters:` and `Raises:` as lists.

They are plain text for readers of the source. As reStructuredText a `*args` or a word with an underscore at its end is
an error; here every character but the backtick stands for itself.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import groupby
from textwrap import dedent

from docutils import nodes
from docutils.parsers import Parser as DocutilsParser

LABELS = "Parameters|Returns|Raises|Warns|Yields"
A_LABEL = re.compile(rf"(?:^|(?<=\.\s)|(?<=\n))({LABELS}):\s+")
# `name : text; other, third : text`, and `Error, OtherError: text; Third: text`
AN_ENTRY = re.compile(r"(?:^|;\s+)(\*{0,2}\w+(?:, \*{0,2}\w+)*)\s?:\s+")
A_BULLET = re.compile(r"(?:[-*]|\d+\.)\s+")


class Parser(DocutilsParser):
    """Parser by the name under which autodoc2 looks for it."""

    supported = ("plain_docstrings",)

    def parse(self, inputstring: str, document: nodes.document) -> None:
        """Append the docstring's nodes to the document."""
        self.setup_parse(inputstring, document)
        document += list(blocks(inputstring))
        self.finish_parse()


def blocks(docstring: str) -> Iterator[nodes.Node]:
    """Yield a node for each block between blank lines."""
    # The first line has no indentation of its own.
    first, _, others = docstring.strip("\n").partition("\n")
    lines = [first.strip(), *dedent(others).splitlines()]
    for is_blank, group in groupby(lines, key=lambda line: not line.strip()):
        if not is_blank:
            yield from block(list(group))


def block(lines: list[str]) -> Iterator[nodes.Node]:
    """Yield the nodes of lines without a blank one among them."""
    if all(line.startswith("    ") for line in lines) or lines[0].startswith("|"):
        text = dedent("\n".join(lines))
        yield nodes.literal_block(text, text, language="python" if lines[0].startswith(" ") else "text")
    elif A_BULLET.match(lines[0]):
        items = re.split(r"\n(?=[-*]\s|\d+\.\s)", "\n".join(lines))
        yield listed([[*inline(A_BULLET.sub("", joined(item), count=1))] for item in items])
    else:
        yield from paragraphs("\n".join(lines))


def paragraphs(text: str) -> Iterator[nodes.Node]:
    """Yield the text before the first label, and behind each label its entries."""
    before, *pairs = A_LABEL.split(text)
    if before.strip():
        yield nodes.paragraph("", "", *inline(joined(before).removesuffix("::") + ":" * before.rstrip().endswith("::")))
    for label, rest in zip(pairs[::2], pairs[1::2], strict=True):
        # A sentence that begins a line behind a full stop belongs to no entry.
        entries, _, after = re.sub(r"(?<=\.)\n(?=[A-Z`])", "\0", rest).partition("\0")
        head, *found = AN_ENTRY.split(joined(entries)) if label != "Returns" else [joined(entries)]
        alone = [[nodes.literal(name, name)] for name in head.rstrip("; ").split("; ") if found and name]
        yield nodes.paragraph("", "", nodes.strong(label, label), nodes.Text(": "), *inline("" if found else head))
        if found:
            yield listed([*alone, *(entry(*pair) for pair in zip(found[::2], found[1::2], strict=True))])
        if after:
            yield nodes.paragraph("", "", *inline(joined(after)))


def entry(name: str, text: str) -> list[nodes.Node]:
    """Return a name and its explanation."""
    return [nodes.literal(name, name), nodes.Text(": "), *inline(text.rstrip("; "))]


def listed(items: list[list[nodes.Node]]) -> nodes.bullet_list:
    """Return a list of one paragraph each."""
    return nodes.bullet_list("", *(nodes.list_item("", nodes.paragraph("", "", *item)) for item in items), bullet="-")


def inline(text: str) -> Iterator[nodes.Node]:
    """Yield text, and as code whatever stands between backticks, single or double."""
    for number, part in enumerate(re.split(r"``?([^`]+)``?", text)):
        if part:
            yield nodes.literal(part, part) if number % 2 else nodes.Text(part)


def joined(text: str) -> str:
    """Return lines as one."""
    return " ".join(text.split())
