"""Xacro and SDF become URDF."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from executor.robots.expand import urdf_of
from executor.robots.urdf import UrdfError

if TYPE_CHECKING:
    from pathlib import Path

XACRO = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:property name="part" value="base"/>
<link name="${part}"/>
</robot>"""


def test_a_urdf_stays_and_macros_are_expanded(tmp_path: Path) -> None:
    plain, macros = tmp_path / "r.urdf", tmp_path / "r.xacro"
    plain.write_text("<robot/>")
    macros.write_text(XACRO)
    assert urdf_of(plain) == b"<robot/>"
    assert b'<link name="base"/>' in urdf_of(macros)


def test_a_wrong_macro_is_reported_with_its_line(tmp_path: Path) -> None:
    path = tmp_path / "r.xacro"
    path.write_text(XACRO.replace("${part}", "${nothing}"))
    with pytest.raises(UrdfError, match=r"xacro: .*nothing") as refused:
        urdf_of(path)
    assert refused.value.line == 3
    with pytest.raises(OSError, match="No such file"):
        urdf_of(tmp_path / "no.xacro")
