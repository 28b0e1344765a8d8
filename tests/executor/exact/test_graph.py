"""The graph of an application whose world is in the same process."""

from __future__ import annotations

import threading
from types import SimpleNamespace
from typing import Any

import pytest

from executor.exact.graph import ExactGraph


def test_its_time_is_that_of_the_world() -> None:
    graph = ExactGraph()
    assert graph.now() == 0.0
    with pytest.raises(RuntimeError, match="not built"):
        _ = graph.node
    world: Any = SimpleNamespace(time_s=2.5)
    ros: Any = SimpleNamespace(application="node")
    graph.join(world, ros)
    graph.sleep(1.0)
    assert (graph.now(), graph.node, graph.is_connected()) == (2.5, "node", True)


def test_another_thread_ends_its_wait() -> None:
    graph = ExactGraph()
    waiter = threading.Thread(target=lambda: graph.spin_once(60))
    waiter.start()
    graph.wake()
    waiter.join(30)
    assert not waiter.is_alive()
    graph.wake()
    graph.spin_once(60)  # a wake before the wait counts
    graph.close()
