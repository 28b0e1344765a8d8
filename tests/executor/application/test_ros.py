"""The graph of an application: where it joins the session's."""

from __future__ import annotations

import random
from typing import TYPE_CHECKING

import psutil

from executor.application.ros import Graph
from executor.ros.environment import discovery_port

if TYPE_CHECKING:
    import pytest

DOMAIN_ID = 222
PARTICIPANT = 17


def ports_of_a_graph(*, outside: bool) -> set[int]:
    graph = Graph(DOMAIN_ID, lambda _: None, outside=outside)
    try:
        return {found.laddr.port for found in psutil.Process().net_connections("udp") if found.laddr}
    finally:
        graph.close()


def test_an_application_takes_ports_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(random.SystemRandom, "randrange", lambda *_: PARTICIPANT)
    ports = ports_of_a_graph(outside=False)
    assert discovery_port(DOMAIN_ID, PARTICIPANT) in ports
    assert not ports & {discovery_port(DOMAIN_ID, before) for before in range(PARTICIPANT)}


def test_in_the_graph_of_a_robot_outside_an_application_is_among_the_first(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(random.SystemRandom, "randrange", lambda *_: PARTICIPANT)
    ports = ports_of_a_graph(outside=True)
    assert ports & {discovery_port(DOMAIN_ID, first) for first in range(4)}
