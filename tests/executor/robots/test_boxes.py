"""Boxes in place of meshes that cannot be read, and the extents of links."""

from __future__ import annotations

import numpy as np
import pytest

from executor.messages import Mesh
from executor.robots.boxes import UNKNOWN_M, extent_of_links, with_boxes
from executor.robots.urdf import parse_urdf
from executor.universes.document import Problem

URDF = b"""<robot name="r"><link name="a">
<visual><geometry><mesh filename="lost.stl"/></geometry></visual>
<visual><origin xyz="0 0 1"/><geometry><cylinder radius="0.5" length="2"/></geometry></visual></link>
<link name="b"><visual><geometry><mesh filename="plate.stl" scale="2 2 2"/></geometry></visual></link>
<link name="c"><visual><geometry><mesh filename="lost.stl"/></geometry></visual></link>
<link name="d"><collision><geometry><capsule radius="1" length="2"/></geometry></collision>
<visual><geometry><sphere radius="9"/></geometry></visual></link>
<joint name="b" type="fixed"><parent link="a"/><child link="b"/></joint>
<joint name="c" type="fixed"><parent link="a"/><child link="c"/></joint>
<joint name="d" type="fixed"><parent link="a"/><child link="d"/></joint></robot>"""
PLATE = Mesh(np.array([[0, 0, 0], [1, 0, 0], [0, 3, 0]], "<f4").tobytes(), b"", b"", b"")


def test_a_broken_mesh_becomes_the_box_of_what_else_is_there() -> None:
    urdf = parse_urdf(URDF)
    made = with_boxes(urdf, {"plate.stl": PLATE}, {"lost.stl": Problem("it is lost", 2, code="BTR004")})
    box, cylinder = made.links["a"].visuals
    assert (box.shape, box.size, box.pose[:3]) == ("box", pytest.approx((1, 1, 2)), pytest.approx((0, 0, 1)))
    assert cylinder == urdf.links["a"].visuals[1]
    assert made.links["b"] == urdf.links["b"]
    assert made.links["c"].visuals[0].size == (UNKNOWN_M,) * 3
    [note] = made.notes
    assert (note.message, note.line) == ("it is lost: a box is shown in its place", 2)


def test_the_extent_of_a_link_is_that_of_what_can_be_touched_or_else_seen() -> None:
    found = extent_of_links(parse_urdf(URDF), {"plate.stl": PLATE})
    assert sorted(found) == ["a", "b", "d"]
    low, high = found["d"]
    assert (*low, *high) == pytest.approx((-1, -1, -2, 1, 1, 2))
    low, high = found["b"]
    assert (*low, *high) == pytest.approx((0, 0, 0, 2, 6, 0))
