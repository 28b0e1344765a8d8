"""The friction that a URDF gives to Gazebo."""

from __future__ import annotations

import pytest
from lxml import etree

from executor.robots.surfaces import MOST, read_frictions
from executor.robots.urdf import parse_urdf

URDF = """<robot name="r"><gazebo/>
<link name="a"><collision><geometry><sphere radius="1"/></geometry></collision></link>
<gazebo reference="{link}">{inside}</gazebo></robot>"""


def read(inside: str, link: str = "a") -> tuple[dict[str, float], list[tuple[int, str]]]:
    urdf = parse_urdf(URDF.format(link=link, inside=inside).encode())
    return urdf.friction, [(note.line, note.message) for note in urdf.notes]


@pytest.mark.parametrize(
    ("inside", "friction"),
    [
        ("<mu1>0.2</mu1><mu2>0.2</mu2>", 0.2),
        ('<mu1 value="0.05"/>', 0.05),
        ("<mu2> 0 </mu2>", 0.0),
        ("<mu1>100000.0</mu1><mu2>100000.0</mu2>", 1.0),
        ("<collision><surface><friction><ode><mu>0.3</mu></ode></friction></surface></collision>", 0.3),
    ],
)
def test_a_link_has_the_friction_of_gazebo(inside: str, friction: float) -> None:
    assert read(inside) == ({"a": friction}, [])


def test_a_link_that_cannot_be_touched_has_no_friction() -> None:
    root = etree.fromstring('<robot><link name="a"/><gazebo reference="a"><mu1>9</mu1></gazebo></robot>')
    assert read_frictions(root) == ({}, [])
    assert MOST == 1.0


def test_what_says_nothing_about_a_surface_leaves_the_default() -> None:
    assert read("<material>Gazebo/Red</material>") == ({}, [])
    assert read("<mu1>0.2</mu1>", link="ghost") == ({}, [])


def test_what_cannot_be_applied_is_noted_with_its_line() -> None:
    friction, [(line, text)] = read("<mu1>1</mu1><mu2>0.1</mu2>")
    assert friction == {"a": 1.0}
    assert (line, "mu1 acts in all directions here" in text) == (3, True)
    for wrong in ("slippery", "-1", "nan"):
        friction, [(line, text)] = read(f"<mu1>{wrong}</mu1>")
        assert friction == {}
        assert (line, f"the friction '{wrong}' of the link 'a'" in text) == (3, True)
