"""Joints that no motor moves, and what a URDF says of wheels: each is simulated as it is written."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import pytest

from executor.robots import load_robot
from executor.universes import parse_universe
from executor.world.geometry.kinematics import joint_pose, link_pose
from executor.world.physics.bullet import BulletWorld
from executor.world.physics.undriven import UndrivenJoints

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    MakeCart = Callable[..., BulletWorld]

YAML = """\
format: bt-studio/robot
version: 1
name: Cart
urdf: cart.urdf
drive: {{left: [left_joint], right: [right_joint], wheel_radius: 0.03, track: 0.2, max_linear: 0.5,
        max_angular: 2}}
wheels: [left, right, ball]
joints: [{joints}]
sensors: []
"""
HEAVY = '<inertial><mass value="3"/><inertia ixx="0.02" iyy="0.02" izz="0.03"/></inertial>'
LIGHT = '<inertial><mass value="0.05"/><inertia ixx="1.5e-5" iyy="1.5e-5" izz="2.5e-5"/></inertial>'
WHEEL = """<link name="{side}"><inertial><origin rpy="1.5707963 0 0"/><mass value="0.05"/>
<inertia ixx="1.5e-5" iyy="1.5e-5" izz="2.5e-5"/></inertial><collision><origin rpy="1.5707963 0 0"/>
<geometry><cylinder radius="0.03" length="0.02"/></geometry></collision></link>
<joint name="{side}_joint" type="continuous"><parent link="base_link"/><child link="{side}"/>
<origin xyz="0 {y} 0.03"/>{wheel}</joint>"""
BALL = '<gazebo reference="ball"><mu1>0</mu1><mu2>0</mu2></gazebo>'
AXIS = '<axis xyz="0 1 0"/>'
LIMIT = '<limit lower="-1" upper="1" effort="20" velocity="5"/>'


@pytest.fixture
def make_cart(tmp_path: Path) -> Iterator[MakeCart]:
    made: list[BulletWorld] = []

    def make(wheel: str = AXIS, more: str = "", joints: str = "", ball: str = BALL) -> BulletWorld:
        folder = tmp_path / "robots" / f"cart{len(made)}"
        folder.mkdir(parents=True)
        wheels = "".join(WHEEL.format(side=s, y=y, wheel=wheel) for s, y in (("left", 0.1), ("right", -0.1)))
        (folder / "robot.yaml").write_text(YAML.format(joints=joints))
        (folder / "cart.urdf").write_text(
            f"""<robot name="cart"><link name="base_link">{HEAVY}<collision><origin xyz="-0.02 0 0.1"/>
<geometry><box size="0.2 0.15 0.1"/></geometry></collision></link>{wheels}
<link name="ball"><collision><geometry><sphere radius="0.02"/></geometry></collision></link>
<joint name="ball_joint" type="fixed"><parent link="base_link"/><child link="ball"/>
<origin xyz="-0.1 0 0.02"/></joint>
<link name="ahead"><collision><geometry><sphere radius="0.02"/></geometry></collision></link>
<joint name="ahead_joint" type="fixed"><parent link="ball"/><child link="ahead"/>
<origin xyz="0.2 0 0"/></joint>
<gazebo reference="ahead"><mu1>0</mu1></gazebo>
{ball}{more}</robot>"""
        )
        text = "format: bt-studio/universe\nversion: 1\nname: t\n"
        made.append(BulletWorld(parse_universe(text), robot=folder.name, assets=tmp_path))
        made[-1].step(120)
        return made[-1]

    yield make
    for world in made:
        world.close()


def drive(world: BulletWorld, seconds: float = 5.0, linear: float = 0.1, angular: float = 0.0) -> None:
    for _ in range(round(seconds * 20)):
        world.robots[0].command(linear, angular)
        world.step(12)


@pytest.mark.parametrize("damping", ["0", "0.2", "0.7", "50"])
def test_damping_of_wheels_neither_speeds_up_nor_spins_a_robot(make_cart: MakeCart, damping: str) -> None:
    world = make_cart(f'{AXIS}<dynamics damping="{damping}" friction="0.1"/>')
    drive(world)
    x, y, yaw = world.robots[0].pose
    assert x == pytest.approx(0.5, abs=0.03)
    assert (y, yaw) == pytest.approx((0.0, 0.0), abs=0.01)
    assert world.robots[0].odometry.x == pytest.approx(x, abs=0.03)


def test_friction_of_a_wheel_takes_its_share_of_the_torque(make_cart: MakeCart) -> None:
    world = make_cart(f'{AXIS}<dynamics friction="5"/>')
    drive(world, 1.0)
    assert abs(world.robots[0].pose[0]) < 0.01
    [note, _] = world.robots[0].config.urdf.notes
    assert "the friction of the joint 'left_joint'" in note.message


@pytest.mark.parametrize("axis", ["0 2 0", "0 0.5 0", "0 1e-3 0"])
def test_the_length_of_a_wheels_axis_has_no_meaning(make_cart: MakeCart, axis: str) -> None:
    world = make_cart(f'<axis xyz="{axis}"/>')
    drive(world)
    assert world.robots[0].pose[0] == pytest.approx(0.5, abs=0.03)
    assert world.robots[0].odometry.x == pytest.approx(world.robots[0].pose[0], abs=0.03)


SLIDE = """<link name="mast">{light}</link><joint name="lift" type="prismatic"><parent link="base_link"/>
<child link="mast"/><origin xyz="0 0 0.2"/><axis xyz="0 0 2"/><limit lower="0" upper="0.6" effort="50"
velocity="1"/></joint>"""


def test_a_sliding_joint_stands_where_it_is_commanded(make_cart: MakeCart) -> None:
    motor = "{joint: lift, topic: /lift, max_rate: 1, torque: 50}"
    world = make_cart(more=SLIDE.format(light=LIGHT), joints=motor)
    robot = world.robots[0]
    for wanted, stands in ((0.5, 0.5), (2.0, 0.6)):
        robot.command_joint("lift", wanted)
        world.step(480)
        position, _ = robot.joint_states()["lift"]
        assert position == pytest.approx(stands, abs=0.005)
        urdf = robot.config.urdf
        assert joint_pose(urdf.joints["lift"], position)[2] == pytest.approx(0.2 + stands, abs=0.005)
        seen = link_pose(urdf, robot.base_pose, "mast", {"lift": position})
        touched = world.bullet.getLinkState(robot.uid, robot._links["mast"])[4]
        assert seen[:3] == pytest.approx(touched, abs=0.002)


FINGERS = """<link name="one">{light}</link><link name="two">{light}</link><link name="three">{light}</link>
<joint name="first" type="revolute"><parent link="base_link"/><child link="one"/><origin xyz="0 0 0.2"/>
<axis xyz="0 0 1"/>{limit}</joint>
<joint name="second" type="revolute"><parent link="base_link"/><child link="two"/><origin xyz="0 0 0.3"/>
<axis xyz="0 0 1"/>{limit}<mimic joint="first" multiplier="-0.5" offset="0.2"/></joint>
<joint name="third" type="continuous"><parent link="base_link"/><child link="three"/><origin xyz="0 0 0.4"/>
<axis xyz="0 0 1"/><mimic joint="second" multiplier="2"/></joint>"""


def test_a_joint_that_mimics_follows_and_has_a_state(make_cart: MakeCart) -> None:
    motor = "{joint: first, topic: /first, max_rate: 2, torque: 5}"
    world = make_cart(more=FINGERS.format(light=LIGHT, limit=LIMIT), joints=motor)
    robot = world.robots[0]
    assert [robot.joint_states()[name][0] for name in ("second", "third")] == pytest.approx(
        [0.2, 0.4], abs=0.01
    )
    robot.command_joint("first", 0.8)
    for _ in range(10):  # also on the way
        world.step(8)
        states = robot.joint_states()
        first = states["first"][0]
        assert states["second"][0] == pytest.approx(0.2 - 0.5 * first, abs=0.05)
    world.step(240)
    states = robot.joint_states()
    assert [states[name][0] for name in ("first", "second", "third")] == pytest.approx(
        [0.8, -0.2, -0.4], abs=0.01
    )
    assert list(states) == ["left_joint", "right_joint", "first", "second", "third"]
    saved = world.save()
    robot.command_joint("first", -0.8)
    world.step(360)
    assert robot.joint_states()["second"][0] == pytest.approx(0.6, abs=0.01)
    world.restore(saved)
    world.step(120)
    assert robot.joint_states()["second"][0] == pytest.approx(-0.2, abs=0.01)


TRAILER = """<link name="rear"><inertial><mass value="0.2"/>
<inertia ixx="1e-4" iyy="1e-4" izz="1e-4"/></inertial>
<collision><origin rpy="1.5707963 0 0"/><geometry><cylinder radius="0.03" length="0.02"/></geometry>
</collision></link><joint name="rear_joint" type="continuous"><parent link="base_link"/><child link="rear"/>
<origin xyz="-0.12 0 0.03"/><axis xyz="0 1 0"/></joint>
<link name="arm">{light}</link><joint name="arm_joint" type="revolute"><parent link="base_link"/>
<child link="arm"/><origin xyz="0 0 0.3"/><axis xyz="0 1 0"/>{limit}</joint>"""


def test_a_castors_wheel_turns_freely_and_an_arm_without_a_motor_is_held(make_cart: MakeCart) -> None:
    world = make_cart(more=TRAILER.format(light=LIGHT, limit=LIMIT))
    robot = world.robots[0]
    drive(world)
    states = robot.joint_states()
    assert robot.pose[0] == pytest.approx(0.5, abs=0.03)
    assert states["rear_joint"][0] == pytest.approx(
        robot.pose[0] / 0.03, rel=0.05
    )  # it rolls, and has a state
    assert states["arm_joint"] == pytest.approx((0.0, 0.0), abs=0.01)


def test_a_robot_whose_joints_all_have_motors_has_no_undriven_ones(make_cart: MakeCart) -> None:
    world = make_cart()
    robot = world.robots[0]
    assert not UndrivenJoints(world.bullet, robot.uid, robot.config, robot._joints)


def test_a_ball_castor_slides_as_gazebo_says(make_cart: MakeCart) -> None:
    """With the default friction it drags, so a turn by odometry is less than the true one."""
    turned = []
    for ball in (BALL, ""):
        world = make_cart(ball=ball)
        robot = world.robots[0]
        assert robot.config.friction.get("ball") == (0.0 if ball else None)
        drive(world, 3.0, 0.0, 1.5)
        turned.append(abs(math.remainder(robot.pose[2] - robot.odometry.yaw, 2 * math.pi)))
    assert turned[0] < 0.05


def test_what_robot_yaml_says_of_friction_counts_more_than_the_urdf(tmp_path: Path) -> None:
    folder = tmp_path / "robots" / "cart"
    folder.mkdir(parents=True)
    text = YAML.format(joints="").replace("sensors: []", "friction: {ball: 0.3}")
    (folder / "robot.yaml").write_text(text)
    wheels = "".join(WHEEL.format(side=side, y=0, wheel=AXIS) for side in ("left", "right"))
    (folder / "cart.urdf").write_text(
        f'<robot name="cart"><link name="base_link"/>{wheels}<link name="ball"><collision><geometry>'
        '<sphere radius="0.02"/></geometry></collision></link><joint name="b" type="fixed">'
        f'<parent link="base_link"/><child link="ball"/></joint>{BALL}'
        '<gazebo reference="left"><mu1>0.4</mu1></gazebo></robot>'
    )
    assert load_robot("cart", tmp_path).friction == {"ball": 0.3, "left": 0.4}
