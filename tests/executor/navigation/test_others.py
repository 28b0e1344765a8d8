"""Nodes that offer navigation, or are expected to."""

from __future__ import annotations

from typing import Any

import pytest

from executor.navigation.others import JOIN_S, SETTLE_S, Others

MAP = "/map"
SPIN = "/spin/_action/send_goal"


class Graph:
    """A graph as a node sees it."""

    def __init__(self) -> None:
        self.names: list[str] = ["world"]
        self.servers: dict[str, int] = {}

    def get_node_names(self) -> list[str]:
        return self.names

    def count_services(self, name: str) -> int:
        return self.servers.get(name, 0)

    count_publishers = count_services


class Clock:
    now_s = 100.0

    def __call__(self) -> float:
        return self.now_s


@pytest.fixture
def graph() -> Any:
    return Graph()


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def others(clock: Clock) -> Others:
    return Others([SPIN], MAP, clock)


def test_nobody_is_expected_unless_somebody_was_named(others: Others, graph: Any) -> None:
    assert not others.are_expected(graph)
    others.expect([])
    assert not others.are_expected(graph)


def test_nodes_have_a_moment_after_all_have_joined(others: Others, graph: Any, clock: Clock) -> None:
    others.expect(["planner", "navigator"])
    graph.names.append("planner")
    assert others.are_expected(graph)
    clock.now_s += 3
    graph.names.append("navigator")
    assert others.are_expected(graph)
    clock.now_s += SETTLE_S - 0.1
    assert others.are_expected(graph)
    clock.now_s += 0.2
    assert not others.are_expected(graph)


def test_a_node_that_does_not_join_is_given_up(others: Others, graph: Any, clock: Clock) -> None:
    others.expect(["navigator"])
    clock.now_s += JOIN_S - 0.1
    assert others.are_expected(graph)
    clock.now_s += 0.2
    assert not others.are_expected(graph)
    graph.names.append("navigator")
    assert not others.are_expected(graph)


def test_a_node_that_joins_late_has_not_longer_than_one_that_does_not(
    others: Others, graph: Any, clock: Clock
) -> None:
    others.expect(["navigator"])
    clock.now_s += JOIN_S - 0.1
    graph.names.append("navigator")
    assert others.are_expected(graph)
    clock.now_s += 0.2
    assert not others.are_expected(graph)


def test_names_replace_those_of_before(others: Others, graph: Any, clock: Clock) -> None:
    others.expect(["navigator"])
    others.expect([])
    assert not others.are_expected(graph)
    others.expect(["planner"])
    graph.names.append("planner")
    assert others.are_expected(graph)
    clock.now_s += SETTLE_S
    assert not others.are_expected(graph)


@pytest.mark.parametrize("name", [MAP, SPIN])
def test_our_own_servers_are_not_those_of_others(others: Others, graph: Any, name: str) -> None:
    assert not others.offer(graph, own=0)
    graph.servers[name] = 1
    assert others.offer(graph, own=0)
    assert not others.offer(graph, own=1)
    graph.servers[name] = 2
    assert others.offer(graph, own=1)
