"""Nodes of Nav2 in imported trees."""

from __future__ import annotations

from translator.importer import from_xml
from translator.nav2.models import LEAST_NODES, nav2_models
from translator.nav2.sources import nav2_source
from tree_gardener.stubs import is_stub

TREE = """<root BTCPP_format="4"><BehaviorTree ID="Main"><RecoveryNode number_of_retries="2">
<DistanceController distance="0.5">
<CheckPoseOccupancy pose="{goal}" service_name="/costs"/></DistanceController>
<Fallback><GoalUpdated/><IsBatteryLow {more}/></Fallback></RecoveryNode></BehaviorTree>{models}</root>"""
OWN = (
    '<TreeNodesModel><Action ID="GoalUpdated"/>'
    '<Condition ID="IsBatteryLow"><input_port name="min_battery"/></Condition></TreeNodesModel>'
)


def text(more: str = 'min_battery="0.2"', models: str = "") -> str:
    return TREE.replace("{more}", more).replace("{models}", models)


def test_a_tree_of_nav2_brings_the_sources() -> None:
    project = from_xml(text())
    assert not any(is_stub(action.source) for action in project.actions.values())
    assert project.actions["DistanceController"].source == nav2_source("DistanceController")
    check = project.actions["CheckPoseOccupancy"]
    assert {port.name for port in check.ports} >= {"pose", "service_name", "cost_threshold"}


def test_a_node_with_other_ports_or_another_model_is_not_that_of_nav2() -> None:
    project = from_xml(text('level="5"', OWN))
    stubs = {name for name, action in project.actions.items() if is_stub(action.source)}
    assert stubs == {"GoalUpdated", "IsBatteryLow"}
    assert not is_stub(project.actions["RecoveryNode"].source)


def test_own_actions_come_first_and_nothing_is_added_without_stubs() -> None:
    own = nav2_source("GoalUpdated")
    assert own is not None
    project = from_xml(text(), actions={"GoalUpdated.py": b"# own\n" + own.encode()})
    assert project.actions["GoalUpdated"].source.startswith("# own")
    assert dict(from_xml(text(), stubs=False).actions) == {}


def test_one_name_alone_may_be_anyones() -> None:
    assert LEAST_NODES == 2
    assert nav2_models({"IsStuck": set(), "Drive": set()}, {}) == {}
    assert set(nav2_models({"IsStuck": set(), "GoalUpdated": set()}, {})) == {"IsStuck", "GoalUpdated"}
