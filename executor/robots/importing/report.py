"""The report of an import: what was taken from a file, assumed, and left out, one line each."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from executor.robots.sdf_model import LINE

if TYPE_CHECKING:
    from collections.abc import Callable

    from lxml import etree


@dataclass
class Report:
    """Lines for the user.

    Args:
        place: returns the name of the file and the line that a line of the URDF comes from.
        file: the name of the file that is imported.
    """

    place: Callable[[int], str]
    file: str
    taken: list[str] = field(default_factory=list)
    assumed: list[str] = field(default_factory=list)
    left_out: list[str] = field(default_factory=list)

    def leave_out(self, element: etree._Element, text: str) -> None:
        """Notes an element that is left out, with its line."""
        self.left_out.append(f"{self.at(element)}: {text}")

    def at(self, element: etree._Element) -> str:
        """Returns the place of an element in the source."""
        line = element.get(LINE)
        return self.place(int(str(element.sourceline))) if line is None else f"{self.file}:{line}"
