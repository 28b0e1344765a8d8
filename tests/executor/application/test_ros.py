"""The graph of an application: where it joins the session's."""

from __future__ import annotations

import json
import random
import subprocess
import sys

import psutil

from executor.application.ros import Graph
from executor.ros.environment import discovery_port
from tests.domains import own_domain_id

PARTICIPANT = 17


def ports_in_this_process(domain_id: int, *, outside: bool) -> list[int]:
    random.SystemRandom.randrange = lambda *_: PARTICIPANT  # type: ignore[method-assign]
    graph = Graph(domain_id, lambda _: None, outside=outside)
    try:
        return [found.laddr.port for found in psutil.Process().net_connections("udp") if found.laddr]
    finally:
        graph.close()


def ports_of_a_graph(domain_id: int, *, outside: bool) -> set[int]:
    """Asks a new process: Fast DDS numbers the participants of a process through all its domains."""
    command = [sys.executable, "-m", __name__, str(domain_id), *(["outside"] if outside else [])]
    asked = subprocess.run(command, stdout=subprocess.PIPE, check=True, timeout=120)
    return set(json.loads(asked.stdout.splitlines()[-1]))


def test_an_application_takes_ports_of_its_own() -> None:
    domain_id = own_domain_id()
    ports = ports_of_a_graph(domain_id, outside=False)
    assert discovery_port(domain_id, PARTICIPANT) in ports
    assert not ports & {discovery_port(domain_id, before) for before in range(PARTICIPANT)}


def test_in_the_graph_of_a_robot_outside_an_application_is_among_the_first() -> None:
    domain_id = own_domain_id()
    ports = ports_of_a_graph(domain_id, outside=True)
    assert ports & {discovery_port(domain_id, first) for first in range(4)}


if __name__ == "__main__":
    sys.stdout.write(json.dumps(ports_in_this_process(int(sys.argv[1]), outside="outside" in sys.argv)))
