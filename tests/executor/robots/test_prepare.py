"""The URDF that the physics engine loads."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from executor.robots.prepare import mesh_path, physical_urdf
from executor.world.geometry.mesh import MeshError

if TYPE_CHECKING:
    from pathlib import Path

URDF = """<robot name="r"><link name="base"><visual><geometry><box size="1 1 1"/></geometry></visual>
<collision><geometry><box size="1 1 1"/></geometry></collision></link></robot>"""


def test_visuals_are_left_out_and_a_link_without_mass_gets_a_little() -> None:
    with physical_urdf(URDF, {}) as path:
        text = path.read_text()
    assert "<visual>" not in text
    assert '<mass value="0.001"/>' in text
    assert not path.exists()


def test_a_root_with_a_mass_of_0_moves() -> None:
    weightless = '<inertial><mass value="0.0"/><inertia ixx="0" iyy="0" izz="0"/></inertial></link>'
    with physical_urdf(URDF.replace("</link>", weightless), {}) as path:
        text = path.read_text()
    assert ('<mass value="0.001"/>' in text, "0.0" in text.replace("0.001", "")) == (True, False)


def test_of_two_inertials_the_one_without_mass_goes() -> None:
    one = '<inertial><mass value="{}"/><inertia ixx="1" iyy="1" izz="1"/></inertial>'
    with physical_urdf(URDF.replace("</link>", f"{one.format(7)}{one.format(0)}</link>"), {}) as path:
        text = path.read_text()
    assert ('<mass value="7"/>' in text, '<mass value="0"/>' in text) == (True, False)


def test_a_mesh_is_in_the_robots_folder(tmp_path: Path) -> None:
    folder = tmp_path / "robot"
    (folder / "meshes").mkdir(parents=True)
    (folder / "meshes" / "a.stl").touch()
    for name in ("meshes/a.stl", "package://robot/meshes/a.stl", "package://any/meshes/a.stl"):
        assert mesh_path(name, folder).samefile(folder / "meshes" / "a.stl")
    with pytest.raises(MeshError, match="lies outside"):
        mesh_path("../../etc/passwd", folder)
