"""Whatever ends an exported program: the robot that it drives stands, and the exit status says why."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import pytest

from tests.action_errors.stopping import CAUSES, Yard, end
from tests.domains import own_domain_id
from tests.tree_gardener.programs import Peer

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")

pytestmark = [
    pytest.mark.simulation,
    pytest.mark.timeout(300),
    pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning"),
]

DOMAIN_ID = own_domain_id()


@pytest.fixture(scope="module")
def yard() -> Iterator[Yard]:
    peer = Peer(DOMAIN_ID)
    yield Yard(peer, DOMAIN_ID)
    peer.close()


@pytest.mark.parametrize(
    ("way", "cause"), [(way, cause) for way, causes in CAUSES.items() for cause in causes]
)
def test_the_robot_stands(yard: Yard, tmp_path: Path, way: str, cause: str) -> None:
    ended = end(yard, tmp_path, way, cause)
    assert ended.stands
    assert ended.status == ended.wanted_status
    assert ended.is_told


@pytest.mark.parametrize("cause", ["a timer", "SIGTERM"])
def test_so_does_one_that_takes_stamped_commands(yard: Yard, tmp_path: Path, cause: str) -> None:
    assert end(yard, tmp_path, "plain", cause, "TwistStamped").stands
