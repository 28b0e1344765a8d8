"""URDF files."""

from __future__ import annotations

import re

import pytest

from executor.robots.urdf import MOST_LINKS, Mimic, UrdfError, parse_urdf
from tests.executor.robots.test_rigid import CART


@pytest.mark.parametrize(
    ("wrong", "right", "says"),
    [
        ('<mass value="-2"/>', '<mass value="2"/>', "cannot be less than 0"),
        ('<mass value="heavy"/>', '<mass value="2"/>', "needs a number as 'value'"),
        ("", '<mass value="2"/>', "needs a <mass> and an <inertia>"),
    ],
)
def test_a_wrong_mass_is_refused_with_its_line(wrong: str, right: str, says: str) -> None:
    with pytest.raises(UrdfError, match=says) as raised:
        parse_urdf(CART.replace(right, wrong).encode(), "cart.urdf")
    assert raised.value.line == 3


def test_a_mass_of_0_is_reported_unless_another_link_carries_it() -> None:
    notes = parse_urdf(CART.replace('<mass value="2"/>', '<mass value="0"/>').encode()).notes
    assert [(note.line, note.code) for note in notes] == [(3, "BTR005")]
    assert "has the mass 0" in notes[0].message
    assert parse_urdf(CART.encode()).notes == ()


def test_a_robot_has_a_largest_number_of_links() -> None:
    link = (
        '<link name="q{0}"/>\n<joint name="t{0}" type="fixed"><parent link="a"/><child link="q{0}"/></joint>'
    )
    text = '<robot name="r"><link name="a"/>' + "".join(map(link.format, range(MOST_LINKS))) + "</robot>"
    with pytest.raises(UrdfError, match=f"at most {MOST_LINKS} links; this has {MOST_LINKS + 1}") as raised:
        parse_urdf(text.encode(), "r.urdf")
    assert raised.value.line == MOST_LINKS


JOINT = """<robot name="r"><link name="a"/><link name="b"/><link name="c"/>
<joint name="j" {type}><parent link="a"/><child link="b"/>
{inside}</joint>
<joint name="k" type="fixed"><parent link="a"/><child link="c"/></joint></robot>"""
LIMIT = '<limit lower="-1" upper="1" effort="1" velocity="1"/>'


def joint(kind: str, inside: str) -> str:
    return JOINT.format(type=f'type="{kind}"', inside=inside)


@pytest.mark.parametrize(
    ("kind", "inside", "line", "says"),
    [
        ("continuous", '<axis xyz="0 0 0"/>', 3, "the axis of the joint 'j' is 0 0 0"),
        ("revolute", "", 2, "the joint 'j' is revolute, so it needs a <limit>"),
        ("prismatic", "", 2, "the joint 'j' is prismatic, so it needs a <limit>"),
        ("floating", "", 2, "the joint 'j' is 'floating'"),
        ("planar", "", 2, "the joint 'j' is 'planar'"),
        ("hinge", "", 2, "the joint 'j' is 'hinge'"),
        ("revolute", '<limit lower="-1" upper="1" velocity="1"/>', 3, "'j' needs effort"),
        ("continuous", '<limit effort="1"/>', 3, "'j' needs velocity"),
        ("revolute", LIMIT.replace('"-1"', '"2"'), 3, "'j' has lower 2, which is above upper 1"),
        ("revolute", LIMIT.replace('effort="1"', 'effort="-1"'), 3, "effort of the joint 'j' cannot be less"),
        (
            "revolute",
            f"{LIMIT}<safety_controller/>",
            3,
            "<safety_controller> of the joint 'j' needs k_velocity",
        ),
        ("continuous", '<dynamics friction="-1"/>', 3, "friction of the joint 'j' cannot be less than 0"),
        ("continuous", "<mimic/>", 3, "<mimic> of the joint 'j' needs joint"),
        ("continuous", '<mimic joint="x"/>', 3, "'j' follows 'x', which does not exist"),
        ("continuous", '<mimic joint="k"/>', 3, "'j' follows 'k', which is fixed"),
        ("continuous", '<mimic joint="j"/>', 3, "'j' follows itself"),
        ("continuous", '<mimic joint="j" offset="far"/>', 3, "needs a number as 'offset'"),
    ],
)
def test_a_wrong_joint_is_refused_with_its_name_and_line(
    kind: str, inside: str, line: int, says: str
) -> None:
    with pytest.raises(UrdfError, match=re.escape(says)) as refused:
        parse_urdf(joint(kind, inside).encode(), "r.urdf")
    assert refused.value.line == line


def test_an_axis_is_a_direction() -> None:
    for text in ("0 3 4", "0 0.3 0.4", "0 30 40"):
        found = parse_urdf(joint("continuous", f'<axis xyz="{text}"/>').encode()).joints["j"]
        assert found.axis == pytest.approx((0.0, 0.6, 0.8))
    assert parse_urdf(joint("fixed", '<axis xyz="0 0 0"/>').encode()).joints["j"].kind == "fixed"


def test_a_joint_has_its_limits_its_friction_and_what_it_follows() -> None:
    inside = f'{LIMIT}<dynamics friction="0.5"/><mimic joint="m" multiplier="-2" offset="0.1"/>'
    other = (
        f'<joint name="m" type="revolute"><parent link="a"/><child link="d"/>{LIMIT}</joint><link name="d"/>'
    )
    text = joint("revolute", inside).replace("</robot>", f"{other}</robot>")
    found = parse_urdf(text.encode()).joints
    assert (found["j"].limits, found["j"].effort, found["j"].friction) == ((-1.0, 1.0), 1.0, 0.5)
    assert found["j"].mimic == Mimic("m", -2.0, 0.1)
    assert found["m"].mimic is None
