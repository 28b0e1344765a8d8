"""The environment in which a process joins a session's graph."""

from __future__ import annotations

from pathlib import Path

from executor.ros.environment import has_tf, lockstep_environment, ros_environment


def test_a_process_joins_its_domain_on_this_host_alone() -> None:
    environment = ros_environment(41)
    assert environment["ROS_DOMAIN_ID"] == "41"
    assert environment["ROS_AUTOMATIC_DISCOVERY_RANGE"] == "LOCALHOST"
    assert Path(environment["FASTDDS_DEFAULT_PROFILES_FILE"]).is_file()


def test_a_graph_in_lockstep_has_a_profile_of_its_own() -> None:
    profile = lockstep_environment()["FASTDDS_DEFAULT_PROFILES_FILE"]
    assert Path(profile).is_file()
    assert profile != ros_environment(0)["FASTDDS_DEFAULT_PROFILES_FILE"]
    assert has_tf() in {True, False}
