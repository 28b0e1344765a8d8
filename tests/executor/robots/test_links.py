"""A model with all its meshes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from executor.robots.links import read_links
from executor.universes.document import DocumentError

if TYPE_CHECKING:
    from pathlib import Path

URDF = """<robot name="r">
<link name="base"><visual><geometry><mesh filename="no.stl"/></geometry></visual></link></robot>"""


def test_links_are_read(tmp_path: Path) -> None:
    (tmp_path / "r.urdf").write_text('<robot name="r"><link name="base"/></robot>')
    urdf, meshes = read_links(tmp_path / "r.urdf", "robots/r/r.urdf")
    assert list(urdf.links) == ["base"]
    assert meshes == {}


@pytest.mark.parametrize(("text", "line"), [(URDF, 2), ("<robot", 1)])
def test_errors_have_their_line(tmp_path: Path, text: str, line: int) -> None:
    (tmp_path / "r.urdf").write_text(text)
    with pytest.raises(DocumentError) as refused:
        read_links(tmp_path / "r.urdf", "robots/r/r.urdf")
    assert refused.value.problems[0].line == line
    with pytest.raises(DocumentError, match="cannot be read"):
        read_links(tmp_path / "no.urdf", "robots/r/no.urdf")
