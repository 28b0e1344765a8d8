"""URDF files."""

from __future__ import annotations

import pytest

from executor.robots.urdf import UrdfError, parse_urdf
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
