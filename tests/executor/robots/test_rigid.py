"""Merged links have the same dynamics: compared by point masses, and in Bullet."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from lxml import etree

from executor.robots.inertia import Inertial
from executor.robots.prepare import physical_urdf
from executor.robots.rigid import merge_fixed_links
from executor.robots.urdf import parse_urdf, read_inertial
from executor.world.engine import Bullet
from executor.world.geometry.transforms import compose, from_xyz_rpy, rotation

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from executor.world.geometry.transforms import Pose

coordinates = st.floats(-2, 2)
poses = st.tuples(*[coordinates] * 3, *[st.floats(-3, 3)] * 3).map(from_xyz_rpy)
clouds = st.lists(st.tuples(*[coordinates] * 3, st.floats(0.1, 3)), min_size=1, max_size=5)

CART = """<robot name="cart">
  <link name="base">
    <inertial><mass value="2"/><inertia ixx="0.1" iyy="0.2" izz="0.3"/></inertial>
    <collision><geometry><box size="0.4 0.2 0.1"/></geometry></collision>
  </link>
  <joint name="mast_joint" type="fixed"><parent link="base"/><child link="mast"/>
    <origin xyz="0.1 0 0.2" rpy="0 0 1.5707963267948966"/></joint>
  <link name="mast">
    <inertial><origin xyz="0 0 0.3"/><mass value="1"/><inertia ixx="0.03" iyy="0.03" izz="0.001"/></inertial>
    <collision><origin xyz="0 0 0.3"/><geometry><box size="0.05 0.1 0.6"/></geometry></collision>
  </link>
  <joint name="arm_joint" type="revolute"><parent link="mast"/><child link="arm"/>
    <origin xyz="0.2 0 0.5"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <link name="arm">
    <inertial><mass value="0.5"/><inertia ixx="0.01" iyy="0.01" izz="0.01"/></inertial>
    <collision><geometry><sphere radius="0.05"/></geometry></collision>
  </link>
  <joint name="caster_joint" type="fixed"><parent link="base"/><child link="caster"/>
    <origin xyz="-0.2 0 -0.05"/></joint>
  <link name="caster"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>
</robot>"""


def _inertial_of(cloud: list[tuple[float, float, float, float]], pose: Pose) -> Inertial:
    """Returns the inertia of points in a frame at a pose."""
    masses = np.array([mass for *_, mass in cloud])
    points = np.array([point for *point, _ in cloud])
    center = masses @ points / masses.sum()
    return Inertial(
        float(masses.sum()), compose(pose, (*center.tolist(), 0, 0, 0, 1)), _tensor(masses, points)
    )


def _tensor(masses: NDArray[np.float64], points: NDArray[np.float64]) -> NDArray[np.float64]:
    shifts = points - masses @ points / masses.sum()
    total = np.zeros((3, 3))
    for m, d in zip(masses, shifts, strict=True):
        total += m * (d @ d * np.eye(3) - np.outer(d, d))
    return total


@given(clouds, poses, clouds, poses)
def test_joined_inertia_is_that_of_all_points(
    one: list[tuple[float, float, float, float]],
    at_one: Pose,
    two: list[tuple[float, float, float, float]],
    at_two: Pose,
) -> None:
    joined = _inertial_of(one, at_one).joined(_inertial_of(two, at_two))
    masses = np.array([mass for *_, mass in one + two])
    points = np.array(
        [
            rotation(pose[3:]) @ np.array(point) + np.array(pose[:3])
            for cloud, pose in ((one, at_one), (two, at_two))
            for *point, _ in cloud
        ]
    )
    assert joined.mass == pytest.approx(masses.sum())
    assert joined.pose[:3] == pytest.approx(masses @ points / masses.sum(), abs=1e-9)
    assert joined.tensor == pytest.approx(_tensor(masses, points), abs=1e-8)


def test_fixed_links_become_one_and_joints_stay_where_they_were() -> None:
    root = etree.fromstring(CART)
    merge_fixed_links(root, {"caster"})
    assert [link.get("name") for link in root.findall("link")] == ["base", "arm", "caster"]
    assert [joint.get("name") for joint in root.findall("joint")] == ["arm_joint", "caster_joint"]
    merged = parse_urdf(etree.tostring(root), "cart.urdf")
    assert merged.joints["arm_joint"].parent == "base"
    assert merged.joints["arm_joint"].origin[:3] == pytest.approx((0.1, 0.2, 0.7))
    base = root.find("link")
    assert base is not None
    assert len(base.findall("collision")) == 2
    inertial = read_inertial(base)
    assert inertial is not None
    assert (inertial.mass, *inertial.pose[:3]) == pytest.approx((3, 0.1 / 3, 0, 0.5 / 3))


def test_a_link_that_feels_otherwise_is_not_merged() -> None:
    root = etree.fromstring(CART.replace('<link name="mast">', '<link name="mast"><contact/>'))
    merge_fixed_links(root, set())
    assert [link.get("name") for link in root.findall("link")] == ["base", "mast", "arm"]


@pytest.fixture
def bullet() -> Iterator[Bullet]:
    server = Bullet()
    yield server
    server.close()


def test_bullet_sees_one_body_as_it_sees_its_parts(bullet: Bullet) -> None:
    """Without gravity, and pushed at the arm, both rotate and move alike."""
    ends = []
    for apart in ((), ("mast", "caster")):
        with physical_urdf(CART, {}, apart) as path:
            uid = bullet.loadURDF(str(path), flags=bullet.URDF_USE_INERTIA_FROM_FILE)
        bullet.setCollisionFilterGroupMask(uid, -1, 0, 0)
        joints = {bullet.getJointInfo(uid, i)[1]: i for i in range(bullet.getNumJoints(uid))}
        for link in range(-1, len(joints)):
            bullet.setCollisionFilterGroupMask(uid, link, 0, 0)
            bullet.changeDynamics(uid, link, linearDamping=0, angularDamping=0)
        arm = joints[b"arm_joint"]
        for _ in range(60):
            bullet.applyExternalForce(uid, arm, (3, 1, 0.5), (0, 0, 0), bullet.LINK_FRAME)
            bullet.stepSimulation()
        state = bullet.getLinkState(uid, arm, computeLinkVelocity=1)
        ends.append([*state[4], *state[6], *state[7], bullet.getJointState(uid, arm)[0]])
        bullet.removeBody(uid)
    assert len(joints) == 3
    assert math.dist(ends[0][:3], (0.1, 0.2, 0.7)) > 0.05
    assert ends[0] == pytest.approx(ends[1], abs=2e-3)
