"""Xacro with places: each line of the output knows where it comes from."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
import xacro

from executor.expansion.tracked import ExpansionError, expand
from tree_gardener.packages import Packages, Place

if TYPE_CHECKING:
    from pathlib import Path

TEXT = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:macro name="pair" params="name *block">
  <link name="${name}_a"/>
  <xacro:insert_block name="block"/>
</xacro:macro>
<xacro:if value="${1 == 1}">
  <xacro:pair name="x"><link name="inner"/></xacro:pair>
</xacro:if>
</robot>"""


def expanded(folder: Path, text: str) -> list[tuple[str, int]]:
    file = folder / "a.xacro"
    file.write_text(text)
    made = expand(file, Packages(folder, [Place("here", folder)]), {})
    lines = made.text.splitlines()
    return [(line.strip(), made.places[i].line) for i, line in enumerate(lines) if "<link" in line]


def test_elements_of_macros_and_blocks_come_from_where_they_are_written(tmp_path: Path) -> None:
    assert expanded(tmp_path, TEXT) == [('<link name="x_a"/>', 3), ('<link name="inner"/>', 7)]


def test_xacro_is_as_before_afterwards_also_after_an_error(tmp_path: Path) -> None:
    before = (xacro.parse, xacro.eval_all)
    with pytest.raises(ExpansionError, match="Undefined block") as refused:
        expanded(tmp_path, TEXT.replace('name="block"', 'name="other"'))
    assert refused.value.place.line == 4
    assert (xacro.parse, xacro.eval_all) == before
