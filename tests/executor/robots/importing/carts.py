"""A small robot in URDF, with parts that tests change or add."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lxml import etree

from executor.robots.importing.report import Report
from executor.robots.urdf import Urdf, parse_urdf

if TYPE_CHECKING:
    from collections.abc import Sequence

BODY = """<link name="base_link"><inertial><mass value="2"/>
<inertia ixx="0.02" iyy="0.02" izz="0.03"/></inertial>
<collision><origin xyz="0 0 0.08"/><geometry><box size="0.2 0.15 0.1"/></geometry></collision></link>"""
CASTOR = """<link name="nose"><collision><geometry><sphere radius="0.02"/></geometry></collision></link>
<joint name="nose_joint" type="fixed"><parent link="base_link"/><child link="nose"/>
<origin xyz="{x} 0 0.02"/></joint>"""


def wheel(
    name: str, x: float, y: float, *, parent: str = "base_link", axis: str = "0 1 0", more: str = ""
) -> str:
    """Returns a wheel with a radius of 4 cm, and its joint."""
    return f"""<link name="{name}"><inertial><origin rpy="1.5707963 0 0"/><mass value="0.2"/>
<inertia ixx="1e-4" iyy="1e-4" izz="2e-4"/></inertial><collision><origin rpy="1.5707963 0 0"/><geometry>
<cylinder radius="0.04" length="0.02"/></geometry></collision></link>
<joint name="{name}_joint" type="continuous"><parent link="{parent}"/><child link="{name}"/>
<origin xyz="{x} {y} 0.04"/><axis xyz="{axis}"/>{more}</joint>"""


PAIR = wheel("left", 0, 0.1) + wheel("right", 0, -0.1)


def robot(*parts: str) -> str:
    """Returns a URDF of these parts."""
    return '<robot name="cart">' + "\n".join(parts) + "</robot>"


def read(parts: Sequence[str]) -> tuple[Urdf, etree._Element, Report]:
    """Returns a robot, its document, and an empty report."""
    text = robot(*parts)
    return (
        parse_urdf(text.encode()),
        etree.fromstring(text),
        Report(lambda line: f"cart.urdf:{line}", "cart.urdf"),
    )
