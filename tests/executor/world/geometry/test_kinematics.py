"""Poses of links from the positions of joints."""

from __future__ import annotations

import math

import pytest

from executor.robots.urdf import parse_urdf
from executor.world.geometry.kinematics import link_pose, mesh_key
from executor.world.geometry.transforms import IDENTITY

URDF = b"""<robot name="r"><link name="base"/><link name="arm"/><link name="tool"/>
<joint name="turn" type="revolute"><parent link="base"/><child link="arm"/>
<origin xyz="0 0 1"/><axis xyz="0 0 1"/>
<limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
<joint name="slide" type="prismatic"><parent link="arm"/><child link="tool"/><axis xyz="1 0 0"/>
<limit lower="0" upper="2" effort="1" velocity="1"/></joint></robot>"""


def test_a_chain_of_joints_turns_and_slides() -> None:
    urdf = parse_urdf(URDF, "r.urdf")
    pose = link_pose(urdf, IDENTITY, "tool", {"turn": math.pi / 2, "slide": 2.0})
    assert pose[:3] == pytest.approx((0.0, 2.0, 1.0))
    assert link_pose(urdf, IDENTITY, "tool", {})[:3] == pytest.approx((0.0, 0.0, 1.0))
    assert mesh_key("robot", "a.stl") != mesh_key("other", "a.stl")
