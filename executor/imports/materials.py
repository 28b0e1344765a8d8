"""Colours of SDF materials."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

from executor.sdf.values import text_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from lxml import etree

GREY: Final = "#9aa4b0"
_BY_NAME: Final = {
    "red": "#ff0000",
    "green": "#00ff00",
    "blue": "#0000ff",
    "yellow": "#ffff00",
    "purple": "#ff00ff",
    "turquoise": "#00ffff",
    "white": "#ffffff",
    "black": "#000000",
    "darkgrey": "#2d2d2d",
    "grey": "#b3b3b3",
    "gray": "#b3b3b3",
    "orange": "#ff8229",
    "indigo": "#5400d1",
    "gold": "#cc9933",
    "wood": "#a87b51",
    "bricks": "#9c5a3c",
    "residential": "#8a8a8a",
}
"""Of the scripts `Gazebo/NAME`."""


def color_of(visual: etree._Element, skip: Callable[[etree._Element, str], None]) -> str:
    """Returns the colour of a visual; grey without a material. What it has beside a colour is listed."""
    material = visual.find("material")
    if material is None:
        return GREY
    for tag in ("diffuse", "ambient"):
        try:
            channels = [float(word) for word in text_of(material, tag).split()][:3]
        except ValueError:
            channels = []
        channels = [min(max(channel, 0.0), 1.0) for channel in channels if math.isfinite(channel)]
        if len(channels) == 3:
            return "#" + "".join(f"{round(channel * 255):02x}" for channel in channels)
    script = material.find("script")
    name = text_of(script, "name").rpartition("/")[2].lower() if script is not None else ""
    if name in _BY_NAME:
        return _BY_NAME[name]
    if script is not None or material.find("pbr") is not None:
        skip(material, "the picture of a <material> is not shown")
    return GREY
