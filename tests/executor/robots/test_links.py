"""A model with all its meshes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from executor.robots.boxes import UNKNOWN_M
from executor.robots.links import read_links
from executor.universes.document import DocumentError
from tree_gardener.packages import Place

if TYPE_CHECKING:
    from pathlib import Path

URDF = """<robot name="r">
<link name="base"><collision><geometry><mesh filename="no.stl"/></geometry></collision></link></robot>"""
SEEN = """<robot name="r"><link name="base">
<visual><origin xyz="0 0 1"/><geometry><mesh filename="{mesh}"/></geometry></visual>
<visual><origin xyz="0 0 2"/><geometry><mesh filename="{mesh}"/></geometry></visual>
{touched}</link></robot>"""
TOUCHED = """<collision><origin xyz="0 0 1" rpy="0 0 1.5707963267948966"/>
<geometry><box size="1 2 3"/></geometry></collision>"""


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


@pytest.mark.parametrize(
    "mesh", ["no.stl", "broken.stl", "../../out.stl", "package://ghost/a.stl", "a.blend"]
)
def test_a_mesh_that_is_only_seen_becomes_a_box_with_a_note(tmp_path: Path, mesh: str) -> None:
    (tmp_path / "broken.stl").write_bytes(b"solid nothing")
    file = tmp_path / "r.urdf"
    file.write_text(SEEN.format(mesh=mesh, touched=TOUCHED))
    urdf, meshes = read_links(file, "robots/r/r.urdf")
    assert meshes == {}
    [box] = urdf.links["base"].visuals
    assert (box.shape, box.size, box.pose[:3]) == ("box", pytest.approx((2, 1, 3)), pytest.approx((0, 0, 1)))
    [note] = urdf.notes
    assert (note.line, note.code) == (3, "BTR004")
    assert note.message.endswith("a box is shown in its place")
    file.write_text(SEEN.format(mesh=mesh, touched=""))
    urdf, _ = read_links(file, "robots/r/r.urdf")
    assert [visual.size for visual in urdf.links["base"].visuals] == [(UNKNOWN_M,) * 3] * 2


HEAD = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'


@pytest.fixture
def cart(tmp_path: Path) -> Path:
    """Returns the folder of a robot as in a ROS package: `urdf/` and `meshes/` beside `package.xml`."""
    cart = tmp_path / "robots" / "cart"
    for folder in ("urdf", "meshes"):
        (cart / folder).mkdir(parents=True)
    (cart / "package.xml").write_text("<package><name>cart_description</name></package>")
    (cart / "meshes" / "plate.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    return cart


@pytest.mark.parametrize("name", ["cart.xacro", "cart.urdf.xacro", "cart.urdf"])
def test_macros_are_expanded_by_whatever_name_and_meshes_in_them_are_found(cart: Path, name: str) -> None:
    (cart / "urdf" / "part.xacro").write_text(
        f'{HEAD}<link name="$(arg top)"><collision><geometry>\n'
        '<mesh filename="file://$(find cart_description)/meshes/plate.obj"/></geometry></collision>'
        "</link></robot>"
    )
    file = cart / "urdf" / name
    file.write_text(
        f'{HEAD}<xacro:arg name="top" default="flat"/>\n'
        '<xacro:include filename="$(find cart_description)/urdf/part.xacro"/></robot>'
    )
    places = [Place("robots/cart", cart)]
    urdf, meshes = read_links(file, f"robots/cart/urdf/{name}", places, {"top": "round"})
    assert list(urdf.links) == ["round"]
    assert list(meshes) == ["package://cart_description/meshes/plate.obj"]


@pytest.mark.parametrize(
    ("part", "error"),
    [
        ('\n<link name="a"/><link name="a"/>', "part.xacro:3:1: BTR002 the link 'a' is defined twice"),
        ('<link name="${a}"/>', "part.xacro:2:1: BTR002 xacro: name 'a' is not defined"),
        ("<link>", "part.xacro:2:7: BTR002 xacro: mismatched tag"),
        (
            '\n<link name="a"><collision><geometry><mesh filename="no.obj"/></geometry></collision></link>',
            "part.xacro:3:1: BTR004 there is no file no.obj",
        ),
    ],
)
def test_an_error_in_an_included_file_names_that_file(cart: Path, part: str, error: str) -> None:
    (cart / "part.xacro").write_text(f"{HEAD}{part}</robot>")
    file = cart / "urdf" / "cart.xacro"
    file.write_text(f'{HEAD}\n\n\n<xacro:include filename="../part.xacro"/></robot>')
    with pytest.raises(DocumentError) as refused:
        read_links(file, "robots/cart/urdf/cart.xacro", [Place("robots/cart", cart)])
    assert str(refused.value).startswith(f"robots/cart/{error.replace(':2:7:', ':2:1:')}")


def test_a_note_about_an_included_file_names_it(cart: Path) -> None:
    seen = '<visual><geometry><mesh filename="no.obj"/></geometry></visual>'
    (cart / "part.xacro").write_text(f'{HEAD}\n<link name="a">{seen}</link></robot>')
    file = cart / "urdf" / "cart.xacro"
    file.write_text(f'{HEAD}<xacro:include filename="../part.xacro"/></robot>')
    urdf, _ = read_links(file, "robots/cart/urdf/cart.xacro", [Place("robots/cart", cart)])
    [note] = urdf.notes
    assert note.message.endswith("(robots/cart/part.xacro:3): a box is shown in its place")


def test_meshes_are_found_by_the_name_of_the_package(cart: Path, tmp_path: Path) -> None:
    places = [Place("robots/cart", cart), Place("the project", tmp_path)]
    for name in (
        "package://cart_description/meshes/plate.obj",
        "model://cart_description/meshes/plate.obj",
        "package://other_name/meshes/plate.obj",
        "../meshes/plate.obj",
        "meshes/plate.obj",
        f"file://{cart}/meshes/plate.obj",
    ):
        file = cart / "urdf" / "cart.urdf"
        file.write_text(URDF.replace("no.stl", name))
        _, meshes = read_links(file, "robots/cart/urdf/cart.urdf", places)
        assert list(meshes) == [name]
