"""The files of robots in a folder, and the arguments that they declare."""

from __future__ import annotations

from typing import TYPE_CHECKING

from executor.robots.importing.candidates import arguments_of, is_robot, robots_in

if TYPE_CHECKING:
    from pathlib import Path


def test_a_robot_is_a_file_that_names_one_and_the_main_one_is_included_by_none(tmp_path: Path) -> None:
    (tmp_path / "wheel.xacro").write_text("<robot/>")
    (tmp_path / "base.urdf").write_text('<robot name="a"/>')
    (tmp_path / "top.xacro").write_text(
        '<robot name="b"><!-- old.urdf --><include filename="base.urdf"/></robot>'
    )
    (tmp_path / "old.urdf").write_text('<robot name="c"/>')
    (tmp_path / "link.urdf").symlink_to(tmp_path / "old.urdf")
    found = {path.name: is_main for path, is_main in robots_in(tmp_path).items()}
    assert found == {"base.urdf": False, "old.urdf": True, "top.xacro": True}
    world = tmp_path / "w.sdf"
    assert [is_robot(world, text) for text in ("<sdf><model name='a'/>", "<sdf><world><model/>")] == [
        True,
        False,
    ]


def test_a_model_that_a_world_includes_is_no_main_one(tmp_path: Path) -> None:
    for name in ("sofa", "cart"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "model.sdf").write_text(f'<sdf><model name="{name}"/></sdf>')
    include = "<include><uri>model://sofa</uri></include>"
    (tmp_path / "house.world").write_text(f'<sdf><world name="w">{include}</world></sdf>')
    found = {path.parent.name: is_main for path, is_main in robots_in(tmp_path).items()}
    assert found == {"sofa": False, "cart": True}


def test_arguments_have_their_defaults() -> None:
    text = '<xacro:arg name="a" default="1"/><xacro:arg\n default=\'\' name=\'b\'/><xacro:arg name="c"/>'
    assert arguments_of(text) == {"a": "1", "b": "", "c": None}
