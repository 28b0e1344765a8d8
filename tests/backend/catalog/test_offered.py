"""The nodes of Nav2 that the palette offers."""

from __future__ import annotations

from typing import Any

from backend.catalog.offered import offered_actions
from translator.nav2.sources import nav2_source
from translator.nav2.tables import table
from tree_gardener.nav2 import NODES


def test_every_node_of_nav2_that_the_engine_implements_is_offered_with_its_source(api: Any) -> None:
    items = {item["name"]: item for item in api.get("catalog/actions?ros_distro=lyrical")["items"]}
    assert items.keys() == NODES.keys()
    assert [action["name"] for action in offered_actions("lyrical")] == sorted(NODES)
    for name, item in items.items():
        assert item["path"] == f"actions/{name}.py"
        assert f"class {name}(" in item["text"]
        assert item["doc"]
        assert item["diagnostics"] == []


def test_the_declarations_are_those_of_the_classes(api: Any) -> None:
    items = {item["name"]: item for item in api.get("catalog/actions")["items"]}
    recovery = items["RecoveryNode"]
    assert (recovery["kind"], recovery["children"]) == ("control", {"min": 2, "max": 2})
    assert [port["name"] for port in recovery["ports"]] == ["number_of_retries"]
    assert items["RateController"]["kind"] == "decorator"
    assert items["GoalUpdated"]["kind"] == "condition"


def test_each_distribution_offers_the_nodes_of_its_nav2(api: Any) -> None:
    jazzy = {item["name"]: item["text"] for item in api.get("catalog/actions")["items"]}
    assert jazzy.keys() == table("jazzy").keys()
    assert jazzy["IsPathValid"] == nav2_source("IsPathValid", "jazzy")
    problem = api.get("catalog/actions?ros_distro=foxy", expect=422)
    assert "foxy" in problem["detail"]
