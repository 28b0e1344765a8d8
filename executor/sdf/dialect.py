"""Parses SDF as Gazebo does: with undeclared prefixes, `--` in comments, blanks before the declaration."""

from __future__ import annotations

import re
from typing import Final

from lxml import etree

from executor.universes.document import Problem

MAX_BYTES: Final = 20_000_000
MAX_ELEMENTS: Final = 200_000
NEWEST: Final = (1, 12)
OLDEST: Final = (1, 0)
_COMMENT: Final = re.compile(r"<!--.*?-->", re.DOTALL)
_DECLARATION: Final = re.compile(r"\s*<\?xml[^>]*\?>")
_ENCODING: Final = re.compile(rb"\s*<\?xml[^>]*?encoding\s*=\s*[\"']([A-Za-z0-9._-]{1,40})[\"']")
_PREFIX: Final = re.compile(r"(?:</?|\s)([A-Za-z_][\w.-]*):[A-Za-z_]")
_FIRST_TAG: Final = re.compile(r"<[A-Za-z_][\w.-]*")
_VERSION: Final = re.compile(r"\s*(\d+)\.(\d+)\s*")


class SdfError(Exception):
    """An SDF document cannot be read; the problem has the line."""

    def __init__(self, message: str, file: str, line: int = 1) -> None:
        self.problem = Problem(message, line, code="BTU005")
        self.file = file
        super().__init__(f"{file}:{line}: {message}")


def parse(data: bytes, file: str) -> etree._Element:
    """Returns the `<sdf>` element of a document.

    Raises:
        SdfError: it is not well-formed, too large, no SDF, or of an unknown version.
    """
    if len(data) > MAX_BYTES or b"<!DOCTYPE" in data:
        raise SdfError("an SDF document has no DOCTYPE and is smaller than 20 MB", file)
    try:
        root = etree.fromstring(_plain(_text(data)), etree.XMLParser(resolve_entities=False, no_network=True))
    except (etree.XMLSyntaxError, ValueError) as error:
        line = getattr(error, "lineno", None) or 1
        raise SdfError(str(getattr(error, "msg", error)), file, line) from error
    if root.tag != "sdf":
        raise SdfError("there is no <world> or <model> in an <sdf> element", file, line_of(root))
    if sum(1 for _ in root.iter()) > MAX_ELEMENTS:
        raise SdfError(f"it has more than {MAX_ELEMENTS} elements", file)
    version_of(root, file)
    return root


def version_of(root: etree._Element, file: str) -> tuple[int, int]:
    """Returns the version of the specification; the newest one where the document names none.

    Raises:
        SdfError: there is no such version.
    """
    text = root.get("version")
    match = _VERSION.fullmatch(text) if text is not None else None
    version = (int(match[1]), int(match[2])) if match else NEWEST
    if (text is not None and match is None) or not OLDEST <= version <= NEWEST:
        newest = ".".join(map(str, NEWEST))
        raise SdfError(f"the version {text!r} of SDF is not known: 1.0 to {newest} are", file, line_of(root))
    return version


def line_of(element: etree._Element) -> int:
    """Returns the line of an element in its file."""
    return int(str(element.sourceline))


def _text(data: bytes) -> str:
    declared = _ENCODING.match(data)
    encoding = "utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig"
    if declared is not None and encoding == "utf-8-sig":
        encoding = declared.group(1).decode("ascii")
        encoding = "utf-8-sig" if encoding.lower() in ("utf-8", "utf8") else encoding
    try:
        return data.decode(encoding, "replace")
    except LookupError:
        return data.decode("utf-8", "replace")


def _plain(text: str) -> str:
    """Returns the text as XML has it; all lines stay where they are. Text before it is dropped."""
    start = max(text.find("<"), 0)
    text = "\n" * text.count("\n", 0, start) + text[start:]
    declaration = _DECLARATION.match(text)
    if declaration is not None:
        text = "\n" * declaration.group().count("\n") + text[declaration.end() :]
    text = _COMMENT.sub(lambda comment: "\n" * comment.group().count("\n"), text)
    missing = sorted(
        prefix for prefix in set(_PREFIX.findall(text)) - {"xml", "xmlns"} if f"xmlns:{prefix}" not in text
    )
    names = "".join(f' xmlns:{prefix}="urn:{prefix}"' for prefix in missing)
    first = _FIRST_TAG.search(text)
    return text if first is None or not names else text[: first.end()] + names + text[first.end() :]
