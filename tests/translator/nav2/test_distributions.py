"""Names of nodes and ports of Nav2 in another distribution."""

from __future__ import annotations

from translator.nav2.distributions import (
    DISTRIBUTIONS,
    NEW_NODES,
    NEW_PORTS,
    NEWEST,
    new_node,
    new_port,
    node_names,
    port_names,
    titled,
)
from translator.nav2.tables import table


def test_each_twin_leads_both_ways_and_is_in_the_tables() -> None:
    for old, new in NEW_NODES.items():
        assert node_names(old) == (old, new)
        assert node_names(new) == (new, old)
        assert new in table(NEWEST)
        assert old not in table(NEWEST)
        assert any(old in table(each) for each in DISTRIBUTIONS)
    for (type_, old), new in NEW_PORTS.items():
        assert port_names(type_, old) == (old, new)
        assert port_names(type_, new) == (new, old)
        ports = [
            {port["name"] for port in table(each).get(type_, {"ports": ()})["ports"]}
            for each in DISTRIBUTIONS
        ]
        assert new in ports[-1]
        assert old not in ports[-1]
        assert any(old in each for each in ports)


def test_all_others_keep_their_name() -> None:
    assert (new_node("Wait"), node_names("Wait"), titled("jazzy")) == ("Wait", ("Wait",), "Jazzy")
    assert (new_port("Wait", "robot_frame"), port_names("Wait", "a")) == ("robot_frame", ("a",))
    assert new_port("IsPathValid", "path") == "path"


def test_what_the_newest_has_no_more_has_a_twin_or_was_never_read() -> None:
    """`global_frame` is declared by two nodes of Humble and Jazzy; neither reads it."""
    gone = set()
    for name in DISTRIBUTIONS[:-1]:
        for type_, node in table(name).items():
            newest = table(NEWEST)[new_node(type_)]
            there = {port["name"] for port in newest["ports"]}
            gone |= {
                (type_, port["name"]) for port in node["ports"] if new_port(type_, port["name"]) not in there
            }
    assert gone == {("GoalReached", "global_frame"), ("RemovePassedGoals", "global_frame")}
