"""Text in XML: attribute values and character data that read back as the same text."""

from __future__ import annotations

_ATTRIBUTE = str.maketrans(
    {"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;", "\n": "&#10;", "\r": "&#13;", "\t": "&#9;"}
)
_TEXT = str.maketrans({"&": "&amp;", "<": "&lt;", ">": "&gt;", "\r": "&#13;"})


def attribute(text: str) -> str:
    """Returns the text escaped for double quotes."""
    return text.translate(_ATTRIBUTE)


def single_quoted(text: str) -> str:
    """Returns the text escaped for single quotes, for files in that style."""
    return text.replace('"', "\0").translate(_ATTRIBUTE).replace("'", "&apos;").replace("\0", '"')


def character_data(text: str) -> str:
    """Returns the text escaped for content between tags."""
    return text.translate(_TEXT)


def cdata(text: str) -> str:
    """Returns the text as a CDATA section; it is split at each mark that would end the section."""
    return "<![CDATA[" + text.replace("]]>", "]]]]><![CDATA[>") + "]]>"
