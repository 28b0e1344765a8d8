"""The drive of a robot is found by what its file says, or it is said why there is none."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from executor.robots.importing.wheels import Base, NoDriveError, find_base
from tests.executor.robots.importing.carts import BODY, CASTOR, PAIR, read, wheel

if TYPE_CHECKING:
    from executor.robots.importing.report import Report

FRICTION = '<gazebo reference="nose"><mu1>0.1</mu1></gazebo>'
SWIVEL = """<link name="fork"/><joint name="fork_joint" type="{kind}"><parent link="base_link"/>
<child link="fork"/><origin xyz="0.1 {y} 0"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>"""


def base(*parts: str) -> tuple[Base, Report]:
    urdf, root, report = read(parts)
    return find_base(urdf, root, {}, report), report


def test_wheels_are_the_continuous_joints_along_y() -> None:
    found, report = base(BODY, PAIR, CASTOR.format(x=0.1))
    assert (found.left, found.right) == (("left_joint",), ("right_joint",))
    assert (found.radius, found.track) == pytest.approx((0.04, 0.2), abs=1e-6)
    assert (found.castors, found.sliding) == (("nose",), ("nose",))
    assert "continuous joints along y" in report.taken[0]
    assert report.assumed == [
        "the link 'nose' stands on the floor and does not turn: it slides without friction",
        "the highest speed is 0.5 m/s",
        "the highest turning rate is 3 rad/s",
        "the torque of a wheel is 2 Nm",
    ]


def test_a_castor_with_a_friction_keeps_it_and_one_in_the_air_is_none() -> None:
    found, _ = base(BODY, PAIR, CASTOR.format(x=0.1), FRICTION)
    assert (found.castors, found.sliding) == (("nose",), ())
    found, _ = base(BODY, PAIR, CASTOR.format(x=0.1).replace("0 0.02", "0 0.05"))
    assert found.castors == ()


def test_several_wheels_a_side_are_ordered_from_front_to_back() -> None:
    four = [wheel(f"w{x}{y}", x / 10, y / 10) for x in (-1, 1) for y in (-1, 1)]
    found, _ = base(BODY, *four)
    assert (found.left, found.right) == (("w11_joint", "w-11_joint"), ("w1-1_joint", "w-1-1_joint"))
    assert found.torque == pytest.approx(2.0)


def test_a_swivelling_castor_is_no_wheel_but_a_wheel_may_hang_on_a_suspension() -> None:
    swivel = SWIVEL.format(kind="continuous", y=0) + wheel("trail", -0.03, 0.01, parent="fork")
    found, _ = base(BODY, PAIR, swivel)
    assert found.left == ("left_joint",)
    assert found.castors == ("trail",)
    assert found.sliding == ()
    spring = SWIVEL.format(kind="prismatic", y=0) + wheel("left", -0.1, 0.1, parent="fork")
    found, _ = base(BODY, spring, wheel("right", 0, -0.1))
    assert found.left == ("left_joint",)


PLUGIN = """<gazebo><plugin filename="gz-sim-diff-drive-system" name="d"><left_joint>a_joint</left_joint>
<left_joint>b_joint</left_joint><right_joint>c_joint</right_joint><wheel_radius>0.05</wheel_radius>
<max_linear_velocity>0.7</max_linear_velocity><max_angular_velocity>1.5</max_angular_velocity>
</plugin></gazebo>"""


def test_the_plugin_of_gazebo_names_wheels_and_speeds() -> None:
    found, report = base(
        BODY, wheel("a", 0.1, 0.1), wheel("b", -0.1, 0.1), wheel("c", 0, -0.1), wheel("d", 0, -0.2), PLUGIN
    )
    assert (found.left, found.right) == (("a_joint", "b_joint"), ("c_joint",))
    assert (found.max_linear, found.max_angular) == (0.7, 1.5)
    assert found.radius == pytest.approx(0.04)
    assert "the plugin says 0.05 m" in report.assumed[0]


@pytest.mark.parametrize(
    ("rate", "effort", "linear", "torque"),
    [("10", "5", 0.4, 5.0), ("1", "0.001", 0.5, 2.0), ("900", "0", 0.5, 2.0)],
)
def test_limits_of_wheels_are_taken_if_a_robot_can_drive_with_them(
    rate: str, effort: str, linear: float, torque: float
) -> None:
    more = f'<limit effort="{effort}" velocity="{rate}"/>'
    found, _ = base(BODY, wheel("left", 0, 0.1, more=more), wheel("right", 0, -0.1, more=more))
    assert (found.max_linear, found.torque) == pytest.approx((linear, torque), abs=1e-6)


@pytest.mark.parametrize(
    ("parts", "message"),
    [
        ([BODY], "it has no wheel"),
        ([BODY, wheel("one", 0, 0.1)], "it has 1 wheel:"),
        ([BODY, wheel("a", 0, 0.1, axis="1 0 0"), wheel("b", 0, -0.1, axis="1 0 0")], "it has no wheel"),
        (
            [BODY, PAIR]
            + [
                SWIVEL.format(kind="revolute", y=y).replace("fork", f"fork{i}")
                + wheel(f"front{i}", 0, 0.01, parent=f"fork{i}")
                for i, y in enumerate((0.1, -0.1))
            ],
            "Ackermann",
        ),
        ([BODY, PAIR, '<gazebo><plugin filename="libgazebo_ros_ackermann_drive.so"/></gazebo>'], "Ackermann"),
        (
            ['<link name="base_link"/>']
            + [
                f'<link name="{n}"/><joint name="{n}_joint" type="continuous"><parent link="base_link"/>'
                f'<child link="{n}"/><origin xyz="0 {y} 0"/><axis xyz="0 1 0"/></joint>'
                for n, y in (("l", 1), ("r", -1))
            ],
            "the wheels have no shape",
        ),
    ],
)
def test_a_robot_that_cannot_be_driven_says_why(parts: list[str], message: str) -> None:
    with pytest.raises(NoDriveError, match=message):
        base(*parts)
