"""TransformAvailable of Nav2."""

from __future__ import annotations

import pytest

from tests.tree_gardener.nav2_ros import RosNode, Trial
from tree_gardener import TickError
from tree_gardener.nav2.transform_available import TransformAvailable

PORTS = 'child="base_link" parent="map"'


def test_it_succeeds_from_the_first_transform_on() -> None:
    ros = RosNode()
    trial = Trial(TransformAvailable, PORTS, ros=ros)
    assert trial.tick() == "F"
    ros.place(0.0)
    assert trial.tick() == "S"
    ros.forget_places()
    assert trial.tick() == "S"
    assert Trial(TransformAvailable, PORTS).tick() == "F"


@pytest.mark.parametrize("ports", ["", 'child="a"', 'child="" parent="b"'])
def test_a_frame_without_a_name_is_an_error(ports: str) -> None:
    with pytest.raises(TickError, match="must both name a frame"):
        Trial(TransformAvailable, ports).tick()
