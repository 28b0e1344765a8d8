from __future__ import annotations

import os
from typing import TYPE_CHECKING

import pytest

from tests.tree_gardener.ros_graph import Graph, graph
from tree_gardener.nav2 import NODES

if TYPE_CHECKING:
    from collections.abc import Iterator

os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")


@pytest.fixture
def ros() -> Iterator[Graph]:
    """A tree with Nav2's nodes beside servers, on real rclpy nodes."""
    with graph() as made:
        made.nodes = NODES
        yield made
