"""Robots show meshes in the colours of their files."""

from __future__ import annotations

from executor.robots.links import read_links
from executor.robots.painting import with_colors
from executor.world.geometry.mesh import load_colored
from tests.executor.world.geometry.test_mesh_colors import BLUE, RED, obj


def test_a_robot_shows_them_where_its_urdf_says_no_colour(tmp_path):
    obj(tmp_path)
    shape = '<geometry><mesh filename="a.obj"/></geometry>'
    green = '<material name="own"><color rgba="0 1 0 1"/></material>'
    (tmp_path / "r.urdf").write_text(
        f"<robot name='r'><link name='l'><visual>{shape}</visual>"
        f"<visual>{shape}{green}</visual></link></robot>"
    )
    urdf, meshes = read_links(tmp_path / "r.urdf", "r.urdf")
    visuals = urdf.links["l"].visuals
    assert {visual.color for visual in visuals} == {RED, BLUE, (0.0, 1.0, 0.0, 1.0)}
    assert {visual.file for visual in visuals} == set(meshes)


def test_a_robot_says_which_colours_are_lost(tmp_path):
    obj(tmp_path, "missing.mtl")
    shape = '<geometry><mesh filename="a.obj"/></geometry>'
    (tmp_path / "r.urdf").write_text(
        f"<robot name='r'>\n<link name='l'><visual>{shape}</visual></link></robot>"
    )
    urdf, _ = read_links(tmp_path / "r.urdf", "r.urdf")
    assert [(note.line, note.message) for note in urdf.notes] == [
        (2, "the materials of a.obj cannot be read")
    ]


def test_a_mesh_that_is_touched_stays_as_a_whole(tmp_path):
    path = obj(tmp_path)
    shape = '<geometry><mesh filename="a.obj"/></geometry>'
    (tmp_path / "r.urdf").write_text(
        f"<robot name='r'><link name='l'><visual>{shape}</visual>"
        f"<collision>{shape}</collision></link></robot>"
    )
    urdf, meshes = read_links(tmp_path / "r.urdf", "r.urdf")
    assert sorted(meshes) == ["a.obj", "a.obj#0", "a.obj#1"]
    assert with_colors(urdf, dict(meshes), {"a.obj": load_colored(path)}) == urdf
