"""Values as Python source, in lines that ament's linters take."""

from __future__ import annotations

from typing import Final

WIDTH: Final = 99
_LONGER: Final = "  # noqa: E501"


def python_literal(value: object, indent: int = 0, before: str = "") -> str:
    """Returns a value as source; what is too long for one line is broken at items and blanks.

    Args:
        value: texts, numbers, and lists and tuples of them.
        indent: the column of the line in which it begins.
        before: what is in this line before it.
    """
    line = repr(value)
    if indent + len(before) + len(line) < WIDTH:
        return line
    inner, space = indent + 4, " " * (indent + 4)
    if isinstance(value, list | tuple):
        rows = [space + _comma(python_literal(item, inner)) for item in value]
        first, last = ("[", "]") if isinstance(value, list) else ("(", ")")
        return "\n".join([first, *rows, " " * indent + last])
    if isinstance(value, str):
        rows = [space + _marked(repr(part), inner) for part in _parts(value, WIDTH - inner - 2)]
        return "\n".join(["(", *rows, " " * indent + ")"])
    return line


def _comma(text: str) -> str:
    """Returns an item with its comma, which goes before the mark of a long line."""
    return f"{text.removesuffix(_LONGER)},{_LONGER}" if text.endswith(_LONGER) else f"{text},"


def _marked(text: str, indent: int) -> str:
    return text + _LONGER if indent + len(text) > WIDTH else text


def _parts(text: str, width: int) -> list[str]:
    """Returns a text in parts that end with a blank, each as long as its width allows."""
    parts = [""]
    for word in text.split(" "):
        if parts[-1] and len(repr(parts[-1] + word)) > width:
            parts.append("")
        parts[-1] += word + " "
    return [*parts[:-1], parts[-1][:-1]]
