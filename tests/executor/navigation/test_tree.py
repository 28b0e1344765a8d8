"""A tree with Nav2's nodes drives through the house without Nav2, and recovers when the way is blocked.

It has the shape of Nav2's own `navigate_to_pose_w_replanning_and_recovery.xml`.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import pytest

from executor.headless.lockstep import LockstepOptions, run_lockstep
from translator.importer import from_xml
from tree_gardener.stubs import is_stub

if TYPE_CHECKING:
    from executor.headless.report import Report
    from executor.world.interface import World
    from tree_gardener import Tree

pytestmark = pytest.mark.simulation

KITCHEN = (4.9, -1.5)
TREE = """<root BTCPP_format="4" main_tree_to_execute="Main"><BehaviorTree ID="Main">
<Sequence>
  <Script code="goal := '4.9;-1.5;0'"/>
  <RecoveryNode number_of_retries="6" name="drive or recover">
    <PipelineSequence name="plan and follow">
      <RateController hz="1.0">
        <RecoveryNode number_of_retries="1" name="plan">
          <ComputePathToPose goal="{goal}" path="{path}" error_code_id="{plan_error}"/>
          <ClearEntireCostmap service_name="global_costmap/clear_entirely_global_costmap"/>
        </RecoveryNode>
      </RateController>
      <RecoveryNode number_of_retries="1" name="follow">
        <FollowPath path="{path}" error_code_id="{follow_error}"/>
        <ClearEntireCostmap service_name="local_costmap/clear_entirely_local_costmap"/>
      </RecoveryNode>
    </PipelineSequence>
    <ReactiveFallback name="recoveries">
      <GoalUpdated goal="{goal}"/>
      <RoundRobin name="one after the other">
        <Spin spin_dist="1.57"/>
        <Wait wait_duration="3"/>
        <BackUp backup_dist="0.15" backup_speed="0.1"/>
      </RoundRobin>
    </ReactiveFallback>
  </RecoveryNode>
</Sequence>
</BehaviorTree></root>"""


def driven(watch: Any = None) -> Report:
    project = from_xml(TREE)
    assert [name for name, action in project.actions.items() if is_stub(action.source)] == []
    options = LockstepOptions(universe="house", duration_s=150.0, tick_hz=20.0)
    return run_lockstep(project, options, watch=watch)


def distance_to_the_kitchen(report: Report) -> float:
    _, x, y, *_ = report.trajectory[-1]
    return math.dist((x, y), KITCHEN)


def test_it_drives_from_the_hall_to_the_kitchen() -> None:
    report = driven()
    assert (report.root_status, report.errors) == ("SUCCESS", [])
    assert distance_to_the_kitchen(report) < 0.3
    assert report.collisions == 0


def test_where_the_way_is_blocked_it_recovers_and_arrives_later() -> None:
    moved: set[str] = set()

    def block(world: World, _: Tree) -> None:
        if 4.0 < world.time_s < 14.0 and "there" not in moved:
            moved.add("there")
            world.move_body("sofa_seat", (-2.3, 0.5, 0.21, 0, 0, 0))
            world.move_body("shoe_rack", (1.0, 1.2, 0.21, 0, 0, 1.57))
        if world.time_s > 14.0 and "away" not in moved:
            moved.add("away")
            world.move_body("sofa_seat", (-3.9, -3.95, 0.21, 0, 0, 0))
            world.move_body("shoe_rack", (-0.6, 1.72, 0.21, 0, 0, 0))

    report = driven(block)
    assert (report.root_status, report.errors) == ("SUCCESS", [])
    assert distance_to_the_kitchen(report) < 0.3
    recoveries = {node.path.rpartition("/")[2].partition(":")[0]: node.ticks for node in report.nodes}
    assert any(ticks > 0 for name, ticks in recoveries.items() if name in {"Spin", "Wait", "BackUp"})


def test_the_pose_of_the_robot_is_known_at_the_first_tick() -> None:
    body = '<Sequence><GetCurrentPose current_pose="{at}"/><Wait wait_duration="0.1"/></Sequence>'
    project = from_xml(f'<root BTCPP_format="4"><BehaviorTree ID="Main">{body}</BehaviorTree></root>')
    report = run_lockstep(project, LockstepOptions(universe="house", duration_s=5.0, tick_hz=20.0))
    assert (report.root_status, report.errors) == ("SUCCESS", [])
