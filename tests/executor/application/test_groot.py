"""Groot2 looks at the tree of a session, and at the one that takes over from it."""

from __future__ import annotations

import os

import pytest

from executor.application.groot import PORT_VARIABLE, ApplicationPublisher
from tests.tree_gardener.debugging.hooked import free_port
from tests.tree_gardener.groot.cpp_program import XML
from tree_gardener import Status, Tree
from tree_gardener.groot import GrootError
from tree_gardener.groot.client import Groot2Client
from tree_gardener.groot.protocol import Hook, HookKey, Mode, Position


@pytest.fixture
def port(monkeypatch: pytest.MonkeyPatch) -> int:
    port = free_port()
    monkeypatch.setenv(PORT_VARIABLE, str(port))
    return port


def test_the_tree_that_runs_is_served_to_who_only_looks(port: int) -> None:
    publisher = ApplicationPublisher.of_environment()
    assert PORT_VARIABLE not in os.environ
    hook = Hook(HookKey(1, Position.BEFORE), Mode.BREAKPOINT, False, Status.SKIPPED, True)
    first, second = Tree.from_xml(XML), Tree.from_xml(XML.replace('name="top"', 'name="new"'))
    with Groot2Client("127.0.0.1", port, 60.0) as client:
        publisher.follow(first)
        assert client.tree().nodes[0].path == "top"
        with pytest.raises(GrootError, match="can only be looked at"):
            client.insert([hook])
        publisher.follow(second)
        assert client.tree().nodes[0].path == "new"
        second.tick_exactly_once()  # follows from here on
        second.tick_exactly_once()
        assert client.statuses()[0][1].status is Status.RUNNING
        with pytest.raises(GrootError, match="needs the ports"):
            ApplicationPublisher(port).follow(first)
        publisher.close()


def test_nothing_is_served_without_a_port() -> None:
    publisher = ApplicationPublisher.of_environment()
    publisher.follow(Tree.from_xml(XML))
    publisher.close()


def test_a_run_is_served_from_any_moment_on_and_no_longer(port: int) -> None:
    publisher, tree = ApplicationPublisher(0), Tree.from_xml(XML)
    publisher.follow(tree)
    with Groot2Client("127.0.0.1", port, 60.0) as client:
        assert publisher.serve(tree, port) is None
        assert publisher.serve(tree, port) is None
        assert client.tree().nodes[0].path == "top"
        assert publisher.serve(tree, 0) is None
    assert ApplicationPublisher(0).serve(tree, port) is None  # the ports are free again


def test_a_port_that_is_taken_is_refused_and_the_last_one_stays(port: int) -> None:
    tree, taken = Tree.from_xml(XML), free_port()
    other, publisher = ApplicationPublisher(taken), ApplicationPublisher(0)
    other.follow(tree)
    assert publisher.serve(tree, port) is None
    refused = publisher.serve(tree, taken)
    assert refused is not None
    assert refused.code == "port_taken"
    assert f"needs the ports {taken}" in refused.message
    with Groot2Client("127.0.0.1", port, 60.0) as client:
        assert client.tree().nodes[0].path == "top"
    publisher.close()
    other.close()
