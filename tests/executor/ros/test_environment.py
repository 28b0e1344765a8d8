"""The environment in which a process joins a session's graph."""

from __future__ import annotations

import contextlib
import socket
from pathlib import Path
from typing import TYPE_CHECKING

from executor.ros import environment
from executor.ros.environment import (
    PARTICIPANTS,
    discovery_port,
    has_tf,
    lockstep_environment,
    ports_of_its_own,
    ros_environment,
)
from tests.domains import own_domain_id

if TYPE_CHECKING:
    import pytest

DOMAIN_ID = own_domain_id()


def first_free_participant() -> int:
    """Returns the participant that Fast DDS would be, which takes the first free port."""
    for participant in range(PARTICIPANTS):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe, contextlib.suppress(OSError):
            probe.bind(("127.0.0.1", discovery_port(DOMAIN_ID, participant)))
            return participant
    return PARTICIPANTS


def test_a_participant_takes_a_random_place_and_leaves_the_ports_before_it_free_again() -> None:
    places = set()
    for _ in range(20):
        with ports_of_its_own(DOMAIN_ID):
            places.add(first_free_participant())
        assert first_free_participant() == 0
    assert len(places) > 3
    assert PARTICIPANTS not in places


def test_places_that_killed_processes_left_are_not_taken(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(environment, "SHARED_MEMORY", tmp_path)
    for participant in set(range(PARTICIPANTS)) - {PARTICIPANTS - 1}:
        (tmp_path / f"fastrtps_port{discovery_port(DOMAIN_ID, participant) + 1}").touch()
    for _ in range(5):
        with ports_of_its_own(DOMAIN_ID):
            assert first_free_participant() == PARTICIPANTS - 1


def test_ports_that_others_hold_do_not_matter() -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
        other.bind(("127.0.0.1", discovery_port(DOMAIN_ID)))
        with ports_of_its_own(DOMAIN_ID):
            assert first_free_participant() > 0


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
