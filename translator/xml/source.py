"""Reads foreign XML: guarded, and with the place of every tag.

The standard library's expat reports line, column and byte offset. DTDs, custom entities and access to the
network are excluded; size, depth, elements and attributes are limited.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING
from xml.parsers import expat

from translator.diagnostic import Diagnostic, Place, TranslatorError, diagnostic
from translator.limits import XML_ATTRIBUTES, XML_BYTES, XML_ELEMENTS, XML_LEVELS, megabytes
from translator.xml.repair import offers, repaired, repairs_of

if TYPE_CHECKING:
    from collections.abc import Iterator

_START_TAG = re.compile(rb"<[^>\"']*(?:\"[^\"]*\"[^>\"']*|'[^']*'[^>\"']*)*>")
_DECLARED = re.compile(rb"\s*<\?xml[^>]*?encoding\s*=\s*[\"']([A-Za-z0-9._-]{1,40})[\"']")
_LATE_DECLARATION = re.compile(rb"\s+<\?xml\s[^>]*\?>")
_ENCODINGS = {"utf-8", "utf8", "us-ascii", "ascii", "iso-8859-1", "latin-1", "windows-1252", "utf-16"}


@dataclass(slots=True, eq=False)
class Element:
    """One element with the byte offsets of its parts; `end` is the offset after its last byte."""

    tag: str
    attributes: dict[str, str]
    line: int
    column: int
    start: int
    open_end: int
    end: int = 0
    children: list[Element] = field(default_factory=list)
    text: str = ""

    def walk(self) -> Iterator[Element]:
        """Yields the element and all its descendants, in the order of the document."""
        stack = [self]
        while stack:
            element = stack.pop()
            yield element
            stack.extend(reversed(element.children))


@dataclass(frozen=True, slots=True, eq=False)
class Source:
    """A parsed document: its bytes as UTF-8, to which offsets refer, and its original encoding."""

    file: str
    data: bytes
    root: Element
    encoding: str
    bom: bytes

    def decoded(self, raw: bytes) -> str:
        """Returns the text of the file's bytes."""
        return raw[len(self.bom) :].decode(self.encoding)

    def encoded(self, data: bytes) -> bytes:
        """Returns changed UTF-8 bytes in the encoding that the file had."""
        if self.encoding == "utf-8":
            return self.bom + data
        return self.bom + data.decode("utf-8").encode(self.encoding, "xmlcharrefreplace")


def parse_source(raw: bytes | str, *, file: str) -> Source:
    """Parses a document.

    Raises:
        TranslatorError: If the document is not well formed, or exceeds the limits for foreign files.
    """
    if len(raw) > XML_BYTES:
        place, limit = Place(file, line=1, column=1), megabytes(XML_BYTES)
        _refuse("BT0003", place, size=megabytes(len(raw)), limit=limit)
    text, encoding, bom = _decode(raw.encode("utf-8", "replace") if isinstance(raw, str) else raw, file)
    data = text.encode("utf-8")
    try:
        root = _Builder(file, data).parse()
    except TranslatorError as error:
        repairs = repairs_of(text) if error.diagnostics[0].code == "BT0701" else []
        if repairs and _is_well_formed(file, repaired(text, repairs)):
            raise TranslatorError(offers(text, repairs, file)) from None
        raise
    return Source(file, data, root, encoding, bom)


def repair_source(raw: bytes) -> bytes:
    """Returns the file with bare characters in attributes escaped, if it can then be read; else unchanged."""
    try:
        text, encoding, bom = _decode(raw, "")
        _Builder("", text.encode("utf-8")).parse()
    except TranslatorError as error:
        if error.diagnostics[0].code != "BT0701":
            return raw
        better = repaired(text, repairs_of(text))
        return bom + better.encode(encoding) if _is_well_formed("", better) else raw
    return raw


def _is_well_formed(file: str, text: str) -> bool:
    try:
        _Builder(file, text.encode("utf-8")).parse()
    except TranslatorError:
        return False
    return True


def _refuse(code: str, place: Place, **values: object) -> None:
    raise TranslatorError([diagnostic(code, place, **values)])


def _decode(raw: bytes, file: str) -> tuple[str, str, bytes]:
    encoding, bom = "utf-8", b""
    for mark, name in ((b"\xef\xbb\xbf", "utf-8"), (b"\xff\xfe", "utf-16-le"), (b"\xfe\xff", "utf-16-be")):
        if raw.startswith(mark):
            encoding, bom = name, mark
            break
    else:
        if (declared := _DECLARED.match(raw)) is not None:
            encoding = declared.group(1).decode("ascii").lower()
    if encoding not in _ENCODINGS and not bom:
        _refuse("BT0702", Place(file, line=1, column=1), encoding=encoding)
    try:
        text = raw[len(bom) :].decode(encoding)
        text.encode("utf-8")
    except UnicodeError as error:
        start = error.start if isinstance(error, UnicodeDecodeError) else 0
        line = raw.count(b"\n", 0, start) + 1
        raise TranslatorError([diagnostic("BT0002", Place(file, line=line, column=1), byte=start)]) from None
    return text, "utf-8" if encoding == "utf8" else encoding, bom


class _Refused(Exception):  # noqa: N818 - never leaves this module
    def __init__(self, found: Diagnostic) -> None:
        self.found = found


class _Builder:
    """Builds the elements from expat's events."""

    def __init__(self, file: str, data: bytes) -> None:
        self.file = file
        self.data = data
        self.count = 0
        self.stack: list[Element] = []
        self.root: Element | None = None
        self.texts: list[list[str]] = []
        parser = expat.ParserCreate("utf-8")
        parser.buffer_text = True
        parser.StartElementHandler = self.start
        parser.EndElementHandler = self.end
        parser.CharacterDataHandler = self.characters
        parser.StartDoctypeDeclHandler = self.doctype
        self.parser = parser

    def parse(self) -> Element:
        # Tinyxml, which BehaviorTree.CPP uses, takes blanks before the declaration.
        late = _LATE_DECLARATION.match(self.data)
        shown = re.sub(rb"[^\n]", b" ", late.group()) + self.data[late.end() :] if late else self.data
        try:
            self.parser.Parse(shown, True)  # noqa: FBT003 - expat takes it by position only
        except expat.ExpatError as error:
            place = Place(self.file, line=error.lineno, column=error.offset + 1)
            problem = expat.ErrorString(error.code) or "the text is not well formed"
            raise TranslatorError([diagnostic("BT0701", place, problem=problem)]) from None
        except _Refused as refused:
            raise TranslatorError([refused.found]) from None
        assert self.root is not None  # noqa: S101 - expat refuses a document without an element
        return self.root

    def place(self) -> Place:
        return Place(
            self.file, line=self.parser.CurrentLineNumber, column=self.parser.CurrentColumnNumber + 1
        )

    def refuse(self, code: str, **values: object) -> None:
        raise _Refused(diagnostic(code, self.place(), **values))

    def doctype(self, *_: object) -> None:
        self.refuse("BT0704")

    def start(self, tag: str, attributes: dict[str, str]) -> None:
        self.count += 1
        if self.count > XML_ELEMENTS:
            self.refuse("BT0705", limit=XML_ELEMENTS)
        if len(self.stack) >= XML_LEVELS:
            self.refuse("BT0706", limit=XML_LEVELS)
        if len(attributes) > XML_ATTRIBUTES:
            self.refuse("BT0707", limit=XML_ATTRIBUTES)
        start = self.parser.CurrentByteIndex
        match = _START_TAG.match(self.data, start)
        assert match is not None  # noqa: S101 - expat has just read this tag
        place = self.place()
        element = Element(tag, attributes, place.line or 1, place.column or 1, start, match.end())
        if self.stack:
            self.stack[-1].children.append(element)
        else:
            self.root = element
        self.stack.append(element)
        self.texts.append([])

    def end(self, _tag: str) -> None:
        element = self.stack.pop()
        element.text = "".join(self.texts.pop())
        if self.data[element.open_end - 2 : element.open_end] == b"/>":
            element.end = element.open_end
        else:
            element.end = self.data.index(b">", self.parser.CurrentByteIndex) + 1

    def characters(self, text: str) -> None:
        if self.texts:
            self.texts[-1].append(text)
