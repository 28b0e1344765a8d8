"""SDF becomes URDF."""

from __future__ import annotations

import pytest

from executor.robots.sdf_model import urdf_of_sdf
from executor.robots.urdf import UrdfError, parse_urdf

SDF = b"""<sdf version="1.9"><model name="cart"><link name="base">
<inertial><mass>2</mass></inertial>
<collision name="c"><geometry><box><size>1 1 1</size></box></geometry></collision></link></model></sdf>"""


def test_a_model_has_its_links() -> None:
    made = urdf_of_sdf(SDF)
    assert list(parse_urdf(made.urdf, "cart.urdf").links) == ["base"]


def test_nonsense_is_refused() -> None:
    with pytest.raises(UrdfError):
        urdf_of_sdf(b"<sdf>")


MORE = """<sdf version="1.9"><model name="cart"><link name="base"/>
<link name="wheel"><collision name="c"><geometry><sphere><radius>1</radius></sphere></geometry>
<surface><friction><ode><mu>{mu}</mu><mu2>{mu}</mu2></ode></friction></surface></collision></link>
<joint name="j" type="{kind}"><parent>base</parent><child>wheel</child>
<axis><xyz>{axis}</xyz><limit><lower>-1</lower><upper>1</upper></limit></axis></joint></model></sdf>"""


def test_the_friction_of_a_surface_is_that_of_its_link() -> None:
    text = MORE.format(mu="100000.0", kind="revolute", axis="0 2 0")
    made = urdf_of_sdf(text.encode())
    urdf = parse_urdf(made.urdf)
    assert urdf.friction == {"wheel": 1.0}
    assert made.left_out == []
    assert parse_urdf(urdf_of_sdf(text.replace("100000.0", "0.05").encode()).urdf).friction == {"wheel": 0.05}


def test_a_ball_castor_slides_and_it_is_said() -> None:
    made = urdf_of_sdf(MORE.format(mu="1", kind="ball", axis="0 1 0").encode())
    urdf = parse_urdf(made.urdf)
    assert urdf.friction == {"wheel": 0.0}
    assert urdf.joints["j"].kind == "fixed"
    assert "the link 'wheel' is a ball castor" in "\n".join(problem.message for problem in made.left_out)


def test_an_axis_is_a_direction_with_its_limits_in_rad_and_m() -> None:
    for kind in ("revolute", "prismatic"):
        joint = parse_urdf(urdf_of_sdf(MORE.format(mu="1", kind=kind, axis="0 2 0").encode()).urdf).joints[
            "j"
        ]
        assert joint.axis == pytest.approx((0.0, 1.0, 0.0))
        assert joint.limits == pytest.approx((-1.0, 1.0))
    with pytest.raises(UrdfError, match="the axis of the joint 'j' is 0 0 0") as refused:
        urdf_of_sdf(MORE.format(mu="1", kind="revolute", axis="0 0 0").encode())
    assert refused.value.line == 5


def links_and_joints(inside: str, version: str = "1.9"):
    text = f"<sdf version='{version}'><model name='m'>{inside}</model></sdf>"
    urdf = parse_urdf(urdf_of_sdf(text.encode()).urdf, "m.urdf")
    return urdf.links, urdf.joints


def test_degrees_and_quaternions_turn_a_visual() -> None:
    shape = "<geometry><box><size>1 1 1</size></box></geometry>"
    for pose in (
        "<pose degrees='true'>0 0 0 0 0 90</pose>",
        "<pose rotation_format='quat_xyzw'>0 0 0 0 0 0.7071068 0.7071068</pose>",
    ):
        links, _ = links_and_joints(f"<link name='a'><visual name='v'>{pose}{shape}</visual></link>")
        assert links["a"].visuals[0].pose[3:] == pytest.approx((0, 0, 0.7071068, 0.7071068), abs=1e-6)


def test_a_joint_holds_frames_and_links_of_models_within() -> None:
    inside = (
        "<link name='a'/><frame name='f' attached_to='a'><pose>1 0 0 0 0 0</pose></frame>"
        "<model name='n'><pose>5 0 0 0 0 0</pose><link name='b'><pose>0 1 0 0 0 0</pose></link></model>"
        "<joint name='j' type='revolute'><parent>f</parent><child>n::b</child><axis/></joint>"
    )
    links, joints = links_and_joints(inside)
    assert list(links) == ["a", "n::b"]
    assert (joints["j"].parent, joints["j"].child, joints["j"].kind) == ("a", "n::b", "continuous")
    assert joints["j"].origin[:3] == pytest.approx((5, 1, 0))


def test_axes_before_version_1_5_are_in_the_frame_of_the_model() -> None:
    inside = (
        "<link name='a'/><link name='b'><pose>0 0 0 0 0 1.5707963</pose></link>"
        "<joint name='j' type='revolute'><parent>a</parent><child>b</child>"
        "<axis><xyz>1 0 0</xyz></axis></joint>"
    )
    assert links_and_joints(inside, "1.4")[1]["j"].axis == pytest.approx((0, -1, 0), abs=1e-6)
    assert links_and_joints(inside, "1.5")[1]["j"].axis == pytest.approx((1, 0, 0), abs=1e-6)


def test_a_joint_that_moves_on_the_world_has_the_world_as_its_root() -> None:
    joint = "<joint name='j' type='{}'><parent>world</parent><child>a</child><axis/></joint>"
    links, joints = links_and_joints(f"<link name='a'/>{joint.format('revolute')}")
    assert (list(links), joints["j"].parent) == (["world", "a"], "world")
    assert links_and_joints(f"<link name='a'/>{joint.format('fixed')}")[1] == {}


def test_limits_of_effort_and_velocity_are_those_of_the_file() -> None:
    limit = "<limit><lower>-1</lower><upper>1</upper><effort>{}</effort><velocity>{}</velocity></limit>"
    for given, expected in (
        (("5", "2"), (b'effort="5"', b'velocity="2"')),
        (("-1", "inf"), (b'"1000"', b'"100"')),
    ):
        text = (
            "<sdf version='1.9'><model name='m'><link name='a'/><link name='b'/>"
            "<joint name='j' type='revolute'>"
            f"<parent>a</parent><child>b</child><axis>{limit.format(*given)}</axis></joint></model></sdf>"
        )
        urdf = urdf_of_sdf(text.encode()).urdf
        assert all(word in urdf for word in expected)


def test_a_link_weighs_what_the_specification_says() -> None:
    made = urdf_of_sdf(b"<sdf version='1.9'><model name='m'><link name='a'/></model></sdf>").urdf
    assert b'<mass value="1"/>' in made
    assert b'ixx="1"' in made


@pytest.mark.parametrize(("mass", "lines"), [("0", [2]), ("-1", [2]), ("0.5", [])])
def test_a_mass_of_0_is_reported_with_its_line(mass: str, lines: list[int]) -> None:
    link = f"<link name='a'>\n<inertial><mass>{mass}</mass></inertial></link>"
    made = urdf_of_sdf(f"<sdf version='1.9'><model name='m'>{link}</model></sdf>".encode())
    assert [note.line for note in made.left_out if "has the mass 0" in note.message] == lines


def test_what_a_robot_loses_is_listed() -> None:
    cone = "<visual name='v'><geometry><cone/></geometry></visual>"
    link = f"<link name='a'><gravity>false</gravity><sensor name='s' type='gps'/>{cone}</link>"
    made = urdf_of_sdf(f"<sdf version='1.9'><model name='m'>{link}<plugin/></model></sdf>".encode())
    text = "\n".join(problem.message for problem in made.left_out)
    assert all(word in text for word in ("gravity", "<sensor>", "<cone>", "<plugin>"))
