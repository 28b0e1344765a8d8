"""The table of Nav2's nodes: each is there, or waits for the leaves of ROS, and has Nav2's ports."""

from __future__ import annotations

import pytest

from translator import inspect_action
from tree_gardener.nav2 import NODES
from tree_gardener.nav2_library import source_of, table

PART_3 = "part 3: actions and services of ROS as blocks"
LEAVES = """
    BackUp DriveOnHeading Spin Wait AssistedTeleop DockRobot UndockRobot CancelControl CancelBackUp
    CancelDriveOnHeading CancelSpin CancelAssistedTeleop CancelWait CancelComputeAndTrackRoute
    CancelFollowObject ClearEntireCostmap ClearCostmapExceptRegion ClearCostmapAroundRobot
    ClearCostmapAroundPose ComputePathToPose ComputePathThroughPoses ComputeRoute ComputeAndTrackRoute
    RemoveInCollisionGoals SmoothPath FollowPath FollowObject NavigateToPose NavigateThroughPoses
    ReinitializeGlobalLocalization ToggleCollisionMonitor CheckPoseOccupancy ValidatePath
    PauseResumeController
"""
WAITING = dict.fromkeys(LEAVES.split(), PART_3)
TYPES = {
    "double": "double",
    "bool": "bool",
    "string": "string",
    "vector<int>": "list[int]",
    **dict.fromkeys(("int", "uint16", "unsigned int", "chrono::milliseconds"), "int"),
}


def test_each_node_is_there_or_waits_for_a_part() -> None:
    assert NODES.keys() | WAITING.keys() == table().keys()
    assert NODES.keys().isdisjoint(WAITING)


@pytest.mark.parametrize("name", NODES)
def test_a_node_has_the_kind_and_the_ports_of_the_table(name: str) -> None:
    source, row = source_of(name), table()[name]
    assert source is not None
    found = inspect_action(source, f"actions/{name}.py")
    assert found.diagnostics == ()
    assert found.kind == row["kind"]
    expected = {
        port["name"]: (port["direction"], TYPES.get(port["type"], "any"), port.get("default"))
        for port in row["ports"]
    }
    ports = {port.name: (port.direction, port.type, port.default) for port in found.ports}
    assert ports == expected
