from __future__ import annotations

import os
from typing import TYPE_CHECKING

import pytest

from tests.tree_gardener.ros_graph import Graph, graph

if TYPE_CHECKING:
    from collections.abc import Iterator

os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")


@pytest.fixture
def ros() -> Iterator[Graph]:
    with graph() as made:
        yield made
