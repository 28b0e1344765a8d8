"""Friction of links that a URDF gives to Gazebo: `<gazebo reference="link"><mu1>…`.

Gazebo takes the lower one of two touching surfaces, and its ground has 1 unless a world says more; our engine
multiplies both. So a value above 1 acts as 1 there, and is 1 here.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

from executor.universes.document import Problem

if TYPE_CHECKING:
    from lxml import etree

MOST: Final = 1.0
_DEEP: Final = "collision/surface/friction/ode/"


def read_frictions(root: etree._Element) -> tuple[dict[str, float], list[Problem]]:
    """Returns the friction of each link that has one and can be touched, and what was not understood."""
    solid = {link.get("name", "") for link in root.iterfind("link") if link.find("collision") is not None}
    frictions: dict[str, float] = {}
    notes: list[Problem] = []
    for element in root.iterfind("gazebo"):
        link = element.get("reference", "")
        if link not in solid:
            continue
        try:
            first, second = (_coefficient(element, *names) for names in (("mu1", "mu"), ("mu2",)))
        except ValueError as error:
            text = f"the friction {error} of the link {link!r} is no number from 0 up: it is left out"
            notes.append(Problem(text, _line(element), code="BTR005"))
            continue
        if first is None:
            first = second
        if first is None:
            continue
        frictions[link] = min(first, MOST)
        if second is not None and min(second, MOST) != frictions[link]:
            text = (
                f"the link {link!r} has mu1 {first:g} and mu2 {second:g}: mu1 acts in all directions here; "
                "`skid` in robot.yaml lets a wheel slide sideways"
            )
            notes.append(Problem(text, _line(element), code="BTR005"))
    return frictions, notes


def _coefficient(element: etree._Element, *names: str) -> float | None:
    for path in (path for name in names for path in (name, _DEEP + name)):
        found = element.find(path)
        if found is not None:
            text = found.get("value") or (found.text or "").strip()
            try:
                value = float(text)
            except ValueError:
                value = math.nan
            if not value >= 0:
                raise ValueError(repr(text))
            return value
    return None


def _line(element: etree._Element) -> int:
    return int(str(element.sourceline))
