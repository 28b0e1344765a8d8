"""The source of a node of Nav2 in each ROS distribution."""

from __future__ import annotations

import ast
import subprocess
import sys

import pytest

from translator import inspect_action
from translator.nav2.distributions import DISTRIBUTIONS, NEWEST
from translator.nav2.sources import TYPES, nav2_source, sources
from translator.nav2.tables import table
from tree_gardener import Status, Tree
from tree_gardener.nav2_library import source_of

WAITING = {"IsPathValid", "IsStopped"}
"""Conditions of Nav2 that wait for an answer or for time; here what takes several ticks is an action."""
ROWS = [(name, type_) for name in DISTRIBUTIONS for type_ in table(name)]


def required_reads(source: str) -> set[str]:
    """Returns the ports that a source reads, that it neither replaces nor asks for first."""
    calls = [node for node in ast.walk(ast.parse(source)) if isinstance(node, ast.Call)]
    named = {
        kind: {
            str(call.args[0].value)
            for call in calls
            if _is(call, kind) and isinstance(call.args[0], ast.Constant)
        }
        for kind in ("read", "is_given")
    }
    return named["read"] - named["is_given"]


def _is(call: ast.Call, name: str) -> bool:
    return (
        isinstance(call.func, ast.Attribute)
        and call.func.attr == name
        and len(call.args) == 1
        and not call.keywords
    )


@pytest.mark.parametrize(("name", "type_"), ROWS)
def test_a_source_declares_the_ports_of_its_distribution_and_reads_no_other(name, type_) -> None:
    source, row = nav2_source(type_, name), table(name)[type_]
    assert source is not None
    found = inspect_action(source, f"actions/{type_}.py")
    assert found.diagnostics == ()
    assert found.kind == ("action" if type_ in WAITING else row["kind"])
    expected = {port["name"]: (port["direction"], port.get("default")) for port in row["ports"]}
    assert {port.name: (port.direction, port.default) for port in found.ports} == expected
    types = {port["name"]: TYPES.get(port["type"], "any") for port in row["ports"]}
    assert all(port.type in {types[port.name], "any"} for port in found.ports)
    assert required_reads(source) <= expected.keys()


def test_the_newest_is_the_engines_and_the_others_say_whose_they_are() -> None:
    assert nav2_source("ValidatePath", NEWEST) == nav2_source("ValidatePath") == source_of("ValidatePath")
    assert nav2_source("ValidatePath", "jazzy") is None
    assert nav2_source("IsPathValid", NEWEST) is None
    assert nav2_source("NoSuchNode", "jazzy") is None
    assert nav2_source("Sequence", "jazzy") is None
    old = nav2_source("IsPathValid", "jazzy")
    assert old is not None
    assert old.startswith('"""IsPathValid of Nav2 in Jazzy."""')
    assert nav2_source("RateController", "humble") == nav2_source("RateController")


def test_all_sources_of_a_node_are_known() -> None:
    assert len(sources("IsPathValid")) == 3
    assert len(sources("RateController")) == 1
    assert sources("Sequence") == frozenset()


def test_ruff_finds_nothing_in_any_source(tmp_path) -> None:
    for name, type_ in ROWS:
        (tmp_path / f"{name}_{type_}.py").write_text(nav2_source(type_, name) or "")
    command = [sys.executable, "-m", "ruff", "check", "--isolated", "--select", "F,E9", str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout


ROBIN = """<root BTCPP_format="4"><BehaviorTree ID="Main"><RoundRobin>
<AlwaysSuccess/><AlwaysSuccess/></RoundRobin></BehaviorTree></root>"""


def after_the_last(name: str) -> list[Status]:
    """Returns the results of three ticks of two children that always succeed."""
    space: dict[str, object] = {}
    exec(compile(nav2_source("RoundRobin", name) or "", "RoundRobin.py", "exec"), space)  # noqa: S102 - ours
    tree = Tree.from_xml(ROBIN, nodes={"RoundRobin": space["RoundRobin"]})
    return [tree.tick_exactly_once() for _ in range(3)]


def test_before_lyrical_a_round_robin_begins_again_after_its_last_child() -> None:
    done, failed = Status.SUCCESS, Status.FAILURE
    assert after_the_last("jazzy") == [done, done, done]
    assert after_the_last("lyrical") == [done, failed, done]
