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
