"""Colours of materials."""

from __future__ import annotations

import pytest
from lxml import etree

from executor.imports.materials import GREY, color_of


@pytest.mark.parametrize(
    ("material", "color", "is_said"),
    [
        ("", GREY, False),
        ("<material><diffuse>1 0.5 0 1</diffuse></material>", "#ff8000", False),
        ("<material><ambient>0 0 2 1</ambient></material>", "#0000ff", False),
        ("<material><diffuse>nan 0 0 1</diffuse><ambient>0 1 0</ambient></material>", "#00ff00", False),
        ("<material><script><name>Gazebo/Red</name></script></material>", "#ff0000", False),
        ("<material><script><name>Shop/Poster</name></script></material>", GREY, True),
        ("<material><pbr/></material>", GREY, True),
    ],
)
def test_a_material_has_a_colour_or_is_listed(material: str, color: str, is_said: bool) -> None:
    said: list[str] = []
    visual = etree.fromstring(f"<visual>{material}</visual>")
    assert color_of(visual, lambda _, message: said.append(message)) == color
    assert bool(said) is is_said
