"""Nodes of Nav2.

Each module is a node, written with the public classes, so that its source can also be a project's
``actions/<Name>.py``. Modules for helpers are in the same folder, and are exported in packages with the
engine. ``Tree.from_xml(text, nodes=NODES)`` runs trees that use them. `nav2_nodes.json` beside the folder
lists all of Nav2's nodes with their ports. The tests compare the control nodes and RateController with Nav2's
own C++ in BehaviorTree.CPP 4.10.
"""

from collections.abc import Mapping
from typing import Final

from tree_gardener.nav2.append_goal_pose_to_goals import AppendGoalPoseToGoals
from tree_gardener.nav2.are_error_codes_present import AreErrorCodesPresent
from tree_gardener.nav2.are_poses_near import ArePosesNear
from tree_gardener.nav2.assisted_teleop import AssistedTeleop
from tree_gardener.nav2.back_up import BackUp
from tree_gardener.nav2.cancel_assisted_teleop import CancelAssistedTeleop
from tree_gardener.nav2.cancel_back_up import CancelBackUp
from tree_gardener.nav2.cancel_compute_and_track_route import CancelComputeAndTrackRoute
from tree_gardener.nav2.cancel_control import CancelControl
from tree_gardener.nav2.cancel_drive_on_heading import CancelDriveOnHeading
from tree_gardener.nav2.cancel_follow_object import CancelFollowObject
from tree_gardener.nav2.cancel_spin import CancelSpin
from tree_gardener.nav2.cancel_wait import CancelWait
from tree_gardener.nav2.check_pose_occupancy import CheckPoseOccupancy
from tree_gardener.nav2.check_stop_status import CheckStopStatus
from tree_gardener.nav2.clear_costmap_around_pose import ClearCostmapAroundPose
from tree_gardener.nav2.clear_costmap_around_robot import ClearCostmapAroundRobot
from tree_gardener.nav2.clear_costmap_except_region import ClearCostmapExceptRegion
from tree_gardener.nav2.clear_entire_costmap import ClearEntireCostmap
from tree_gardener.nav2.compute_and_track_route import ComputeAndTrackRoute
from tree_gardener.nav2.compute_path_through_poses import ComputePathThroughPoses
from tree_gardener.nav2.compute_path_to_pose import ComputePathToPose
from tree_gardener.nav2.compute_route import ComputeRoute
from tree_gardener.nav2.concatenate_paths import ConcatenatePaths
from tree_gardener.nav2.controller_selector import ControllerSelector
from tree_gardener.nav2.distance_controller import DistanceController
from tree_gardener.nav2.distance_traveled import DistanceTraveled
from tree_gardener.nav2.dock_robot import DockRobot
from tree_gardener.nav2.drive_on_heading import DriveOnHeading
from tree_gardener.nav2.extract_route_nodes_as_goals import ExtractRouteNodesAsGoals
from tree_gardener.nav2.follow_object import FollowObject
from tree_gardener.nav2.follow_path import FollowPath
from tree_gardener.nav2.get_current_pose import GetCurrentPose
from tree_gardener.nav2.get_next_few_goals import GetNextFewGoals
from tree_gardener.nav2.get_pose_from_path import GetPoseFromPath
from tree_gardener.nav2.global_updated_goal import GlobalUpdatedGoal
from tree_gardener.nav2.goal_checker_selector import GoalCheckerSelector
from tree_gardener.nav2.goal_reached import GoalReached
from tree_gardener.nav2.goal_updated import GoalUpdated
from tree_gardener.nav2.goal_updated_controller import GoalUpdatedController
from tree_gardener.nav2.goal_updater import GoalUpdater
from tree_gardener.nav2.initial_pose_received import InitialPoseReceived
from tree_gardener.nav2.is_battery_charging import IsBatteryCharging
from tree_gardener.nav2.is_battery_low import IsBatteryLow
from tree_gardener.nav2.is_goal_nearby import IsGoalNearby
from tree_gardener.nav2.is_stuck import IsStuck
from tree_gardener.nav2.is_within_path_tracking_bounds import IsWithinPathTrackingBounds
from tree_gardener.nav2.navigate_through_poses import NavigateThroughPoses
from tree_gardener.nav2.navigate_to_pose import NavigateToPose
from tree_gardener.nav2.nonblocking_sequence import NonblockingSequence
from tree_gardener.nav2.path_expiring_timer import PathExpiringTimer
from tree_gardener.nav2.path_handler_selector import PathHandlerSelector
from tree_gardener.nav2.path_longer_on_approach import PathLongerOnApproach
from tree_gardener.nav2.pause_resume_controller import PauseResumeController
from tree_gardener.nav2.persistent_sequence import PersistentSequence
from tree_gardener.nav2.pipeline_sequence import PipelineSequence
from tree_gardener.nav2.planner_selector import PlannerSelector
from tree_gardener.nav2.progress_checker_selector import ProgressCheckerSelector
from tree_gardener.nav2.rate_controller import RateController
from tree_gardener.nav2.recovery_node import RecoveryNode
from tree_gardener.nav2.reinitialize_global_localization import ReinitializeGlobalLocalization
from tree_gardener.nav2.remove_in_collision_goals import RemoveInCollisionGoals
from tree_gardener.nav2.remove_passed_goals import RemovePassedGoals
from tree_gardener.nav2.round_robin import RoundRobin
from tree_gardener.nav2.single_trigger import SingleTrigger
from tree_gardener.nav2.smooth_path import SmoothPath
from tree_gardener.nav2.smoother_selector import SmootherSelector
from tree_gardener.nav2.speed_controller import SpeedController
from tree_gardener.nav2.spin import Spin
from tree_gardener.nav2.time_expired import TimeExpired
from tree_gardener.nav2.toggle_collision_monitor import ToggleCollisionMonitor
from tree_gardener.nav2.transform_available import TransformAvailable
from tree_gardener.nav2.truncate_path import TruncatePath
from tree_gardener.nav2.truncate_path_local import TruncatePathLocal
from tree_gardener.nav2.undock_robot import UndockRobot
from tree_gardener.nav2.validate_path import ValidatePath
from tree_gardener.nav2.wait import Wait
from tree_gardener.nav2.would_a_controller_recovery_help import WouldAControllerRecoveryHelp
from tree_gardener.nav2.would_a_planner_recovery_help import WouldAPlannerRecoveryHelp
from tree_gardener.nav2.would_a_route_recovery_help import WouldARouteRecoveryHelp
from tree_gardener.nav2.would_a_smoother_recovery_help import WouldASmootherRecoveryHelp

NODES: Final[Mapping[str, type]] = {
    cls.__name__: cls
    for cls in (
        AppendGoalPoseToGoals,
        AreErrorCodesPresent,
        ArePosesNear,
        AssistedTeleop,
        BackUp,
        CancelAssistedTeleop,
        CancelBackUp,
        CancelComputeAndTrackRoute,
        CancelControl,
        CancelDriveOnHeading,
        CancelFollowObject,
        CancelSpin,
        CancelWait,
        CheckPoseOccupancy,
        CheckStopStatus,
        ClearCostmapAroundPose,
        ClearCostmapAroundRobot,
        ClearCostmapExceptRegion,
        ClearEntireCostmap,
        ComputeAndTrackRoute,
        ComputePathThroughPoses,
        ComputePathToPose,
        ComputeRoute,
        ConcatenatePaths,
        ControllerSelector,
        DistanceController,
        DistanceTraveled,
        DockRobot,
        DriveOnHeading,
        ExtractRouteNodesAsGoals,
        FollowObject,
        FollowPath,
        GetCurrentPose,
        GetNextFewGoals,
        GetPoseFromPath,
        GlobalUpdatedGoal,
        GoalCheckerSelector,
        GoalReached,
        GoalUpdated,
        GoalUpdatedController,
        GoalUpdater,
        InitialPoseReceived,
        IsBatteryCharging,
        IsBatteryLow,
        IsGoalNearby,
        IsStuck,
        IsWithinPathTrackingBounds,
        NavigateThroughPoses,
        NavigateToPose,
        NonblockingSequence,
        PathExpiringTimer,
        PathHandlerSelector,
        PathLongerOnApproach,
        PauseResumeController,
        PersistentSequence,
        PipelineSequence,
        PlannerSelector,
        ProgressCheckerSelector,
        RateController,
        RecoveryNode,
        ReinitializeGlobalLocalization,
        RemoveInCollisionGoals,
        RemovePassedGoals,
        RoundRobin,
        SingleTrigger,
        SmoothPath,
        SmootherSelector,
        SpeedController,
        Spin,
        TimeExpired,
        ToggleCollisionMonitor,
        TransformAvailable,
        TruncatePath,
        TruncatePathLocal,
        UndockRobot,
        ValidatePath,
        Wait,
        WouldAControllerRecoveryHelp,
        WouldAPlannerRecoveryHelp,
        WouldARouteRecoveryHelp,
        WouldASmootherRecoveryHelp,
    )
}
