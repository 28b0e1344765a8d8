"""Damping that the engine's steps can carry, and axes of length 1."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lxml import etree

from executor.robots.stable import STEP_S, bounded_damping, settle_joints

URDF = """<robot name="r"><link name="a"/><link name="b">
<inertial><origin xyz="0 0 {shift}" rpy="1.5707963 0 0"/>
<mass value="0.5"/><inertia ixx="1" iyy="2" izz="3"/></inertial></link>
<joint name="j" type="{kind}"><parent link="a"/><child link="b"/><axis xyz="0 2 0"/>
<dynamics damping="0.2" friction="0.1"/></joint></robot>"""


@given(st.floats(1e-6, 1e6), st.floats(1e-9, 1e3))
def test_a_step_never_turns_a_link_back(damping: float, inertia: float) -> None:
    bounded = bounded_damping(damping, inertia)
    assert 0.0 < bounded <= damping * (1 + 1e-9)
    assert bounded * STEP_S / inertia <= 1.0 + 1e-9


def test_a_step_acts_as_the_exact_solution_and_little_damping_stays() -> None:
    assert 1.0 - bounded_damping(2.0, 0.01) * STEP_S / 0.01 == pytest.approx(
        2.718281828 ** (-2.0 * STEP_S / 0.01)
    )
    assert bounded_damping(1e-4, 10.0) == pytest.approx(1e-4, rel=1e-5)
    assert bounded_damping(1.0, 0.0) == 0.0


@pytest.mark.parametrize(
    ("kind", "shift", "inertia"), [("continuous", "0", 3.0), ("revolute", "2", 5.0), ("prismatic", "2", 0.5)]
)
def test_the_inertia_is_that_about_the_axis(kind: str, shift: str, inertia: float) -> None:
    root = etree.fromstring(URDF.format(kind=kind, shift=shift))
    settle_joints(root)
    [joint] = root.findall("joint")
    assert [float(word) for word in joint.find("axis").get("xyz").split()] == [0.0, 1.0, 0.0]
    dynamics = joint.find("dynamics")
    assert float(dynamics.get("damping")) == pytest.approx(bounded_damping(0.2, inertia), rel=1e-6)
    assert dynamics.get("friction") == "0.1"


def test_a_fixed_joint_is_left_alone() -> None:
    root = etree.fromstring(URDF.format(kind="fixed", shift="0"))
    before = etree.tostring(root)
    settle_joints(root)
    assert etree.tostring(root) == before
