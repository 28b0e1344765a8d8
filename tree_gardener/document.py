"""XML documents with the position of every element.

Reading is strict and safe: no DTD, no entities, bounded size, depth and number of elements.
"""

import dataclasses
import re
import textwrap
from collections.abc import Iterator
from typing import Any, Final, NoReturn
from xml.parsers import expat

from tree_gardener.errors import Diagnostic, LoadError

NAMED_BY_ID: Final = frozenset(("Action", "Condition", "Control", "Decorator", "SubTree"))
"""The tags of nodes whose ID says what they are."""
MAX_BYTES: Final = 64 * 1024 * 1024
MAX_ELEMENTS: Final = 1_000_000
MAX_XML_DEPTH: Final = 1_000
"""The largest depth of XML elements. The depth of nodes is limited to 256, as in BT.CPP (`structure`)."""

NO_ELEMENTS: Final[list[Any]] = []
"""The children of elements that have none; never filled."""
_HINTS: Final = {
    "mismatched tag": "close every element that is opened, in reverse order",
    "not well-formed (invalid token)": "attribute values need quotes; write '<' as &lt; and '&' as &amp;",
    "duplicate attribute": "give each attribute once",
    "junk after document element": "a document has one root element",
    "no element found": 'a document begins with <root BTCPP_format="4">',
    "undefined entity": "known are &lt; &gt; &amp; &quot; and &apos;",
}


class Element:
    """An XML element.

    Attributes:
        tag: its name.
        attributes: its attributes, in the order of the document.
        children: the elements that it contains.
        text: its text; collected only inside of ``<Code>``.
        offset: the offset of its first byte in the document.
    """

    __slots__ = ("attributes", "children", "offset", "tag", "text")

    def __init__(self, tag: str, attributes: dict[str, str], offset: int) -> None:
        self.tag = tag
        self.attributes = attributes
        self.children: list[Element] = NO_ELEMENTS
        self.text = ""
        self.offset = offset

    @property
    def type_id(self) -> str:
        """The ID of a SubTree or of the explicit form, else the tag: the name of a node that has none."""
        return self.attributes.get("ID", "") if self.tag in NAMED_BY_ID else self.tag

    def walk(self) -> Iterator["Element"]:
        """Yields the element and all its descendants, in the order of the document."""
        stack = [self]
        while stack:
            element = stack.pop()
            yield element
            stack.extend(reversed(element.children))


@dataclasses.dataclass(frozen=True)
class Document:
    """A parsed document.

    Attributes:
        name: the name of the document in messages.
        data: the bytes of the document.
        root: the document element.
    """

    name: str
    data: bytes
    root: Element

    def locate(self, offset: int) -> tuple[int, int]:
        """Returns line and column, both from 1, of a byte offset."""
        line = self.data.count(b"\n", 0, offset) + 1
        start = self.data.rfind(b"\n", 0, offset) + 1
        return line, len(self.data[start:offset].decode("utf-8", "replace")) + 1

    def locate_value(self, element: Element, attribute: str) -> int:
        """Returns the offset of the first character of an attribute's value.

        Without it, the element's offset.
        """
        pattern = re.compile(rb"""\s""" + re.escape(attribute.encode()) + rb"""\s*=\s*["']""")
        match = pattern.search(self.data, element.offset)
        return element.offset if match is None else match.end()

    def skip(self, offset: int, characters: int) -> int:
        """Returns the offset after a number of characters; a reference such as ``&lt;`` counts as one."""
        text = self.data[offset:].decode("utf-8", "replace") if characters else ""
        position = 0
        for _ in range(characters):
            end = text.find(";", position) if text[position : position + 1] == "&" else position
            position = end + 1
        return offset + len(text[:position].encode())

    def diagnostic(  # noqa: PLR0913 - one diagnostic
        self,
        element: Element,
        code: str,
        message: str,
        hint: str = "",
        *,
        attribute: str = "",
        span_start: int = 0,
        tree: str = "",
    ) -> Diagnostic:
        """Makes a diagnostic at an element, at one of its attributes, or inside that attribute's value."""
        offset = element.offset
        if attribute in element.attributes:
            offset = self.skip(self.locate_value(element, attribute), span_start)
        line, column = self.locate(offset)
        return Diagnostic(
            code=code,
            message=message,
            hint=hint,
            file=self.name,
            line=line,
            column=column,
            tree=tree,
            node=element.tag,
            node_id=element.attributes.get("_bts_id", ""),
            port=attribute,
        )


def parse_document(text: str | bytes, name: str = "tree.xml") -> Document:
    """Parses XML.

    Raises:
        LoadError: the document is not well-formed, has a DTD, or is too large.
    """
    data = text.encode() if isinstance(text, str) else text
    if len(data) > MAX_BYTES:
        raise LoadError([Diagnostic("TG101", f"the document is larger than {MAX_BYTES} bytes", file=name)])
    return _Reader(data, name, "utf-8" if isinstance(text, str) else None).read()


class _Reader:
    """Builds elements from expat's events."""

    def __init__(self, data: bytes, name: str, encoding: str | None) -> None:
        self.data = data
        self.name = name
        self.parser = expat.ParserCreate(encoding)
        self.parser.buffer_text = True
        self.above = Element("", {}, 0)
        """Holds the document element."""
        self.handle([self.above])
        self.parser.StartDoctypeDeclHandler = self.refuse_dtd

    def read(self) -> Document:
        try:
            self.parser.Parse(self.data, True)  # noqa: FBT003 - expat takes no keywords
        except expat.ExpatError as error:
            message = expat.ErrorString(error.code) or "it cannot be read"
            hint = _HINTS.get(message, "")
            if not self.data.strip():
                message, hint = "it is empty", _HINTS["no element found"]
            raise LoadError(
                [
                    Diagnostic(
                        *("TG102", f"the document is not XML: {message}", hint),
                        file=self.name,
                        line=error.lineno,
                        column=error.offset + 1,
                    )
                ]
            ) from None
        return Document(self.name, self.data, self.above.children[0])

    def handle(self, stack: list[Element]) -> None:
        """Installs the handlers; `stack` are the open elements.

        They are called for each element of a tree, so they are functions whose variables are at hand, and an
        element is made without a call of its constructor.
        """
        parser, push, pop, make = self.parser, stack.append, stack.pop, Element.__new__
        count = 0

        def start(tag: str, attributes: dict[str, str]) -> None:
            nonlocal count
            element = make(Element)
            element.tag = tag
            element.attributes = attributes
            element.offset = parser.CurrentByteIndex
            element.children = NO_ELEMENTS
            element.text = ""
            above = stack[-1]
            if above.children:
                above.children.append(element)
            else:
                above.children = [element]
            push(element)
            count += 1
            if count > MAX_ELEMENTS or len(stack) > MAX_XML_DEPTH + 1:
                self.fail("TG101", "the document has too many or too deeply nested elements", "use SubTrees")
            if tag == "Code":
                parser.CharacterDataHandler = characters

        def end(tag: str) -> None:
            pop()
            if tag == "Code":
                parser.CharacterDataHandler = None

        def characters(text: str) -> None:
            stack[-1].text += text

        parser.StartElementHandler = start
        parser.EndElementHandler = end

    def refuse_dtd(self, *_: Any) -> None:
        self.fail("TG103", "the document has a DTD", "remove <!DOCTYPE …>; documents need none")

    def fail(self, code: str, message: str, hint: str) -> NoReturn:
        line, column = self.parser.CurrentLineNumber, self.parser.CurrentColumnNumber + 1
        raise LoadError([Diagnostic(code, message, hint, file=self.name, line=line, column=column)])


def embedded_sources(document: Document) -> dict[str, str]:
    """Returns the sources of the actions in ``<Code>``, by name; reads both self-contained forms.

    The modules that actions import are left out.
    """
    sources = {}
    for code in document.root.children:
        if code.tag != "Code":
            continue
        for element in code.children:
            if _is_module(element):
                continue
            is_action = element.tag == "Action" and "name" in element.attributes
            name = element.attributes["name"] if is_action else element.tag
            sources[name] = element.text if is_action else textwrap.dedent(element.text)
    return sources


def embedded_modules(document: Document) -> dict[str, str]:
    """Returns the sources in ``<Code>`` that actions import, by name: ``<Module name="…">``."""
    codes = (code for code in document.root.children if code.tag == "Code")
    return {
        element.attributes["name"]: element.text
        for code in codes
        for element in code.children
        if _is_module(element)
    }


def _is_module(element: Element) -> bool:
    return element.tag == "Module" and "name" in element.attributes
