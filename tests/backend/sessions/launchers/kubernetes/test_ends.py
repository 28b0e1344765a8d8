"""Readings of pods; `test_launcher.py` has the reasons as users read them."""

from __future__ import annotations

from typing import Any

import msgspec
import pytest
from lightkube.resources.core_v1 import Pod

from backend.sessions.launchers.base import UNKNOWN_EXIT
from backend.sessions.launchers.kubernetes.ends import Cause, Seen, Trouble, read_pod

READY = {"type": "Ready", "status": "True"}


def seen(status: dict[str, Any] | None, **metadata: Any) -> Seen:
    body = {"metadata": {"name": "p", "uid": "u", **metadata}}
    return read_pod(msgspec.convert(body if status is None else body | {"status": status}, Pod))


def test_a_new_pod_says_nothing() -> None:
    assert seen(None) == seen({"phase": "Pending"}) == Seen("u")
    assert not Seen("u").is_decided


def test_a_pod_that_listens_has_its_address() -> None:
    found = seen({"phase": "Running", "podIP": "10.0.0.7", "conditions": [READY]})
    assert found == Seen("u", address="10.0.0.7", is_ready=True)
    assert found.is_decided


def test_a_pod_that_has_ended_is_not_ready_although_its_condition_says_so() -> None:
    found = seen({"phase": "Failed", "conditions": [READY]})
    assert (found.is_ready, found.exit_status) == (False, UNKNOWN_EXIT)


def test_a_pod_that_is_deleted_by_us_runs_until_it_has_ended() -> None:
    found = seen({"phase": "Running", "conditions": [READY]}, deletionTimestamp="2026-01-01T00:00:00Z")
    assert found.exit_status is None


@pytest.mark.parametrize("cause", Cause)
def test_each_cause_is_a_sentence_and_says_more_where_kubernetes_does(cause: Cause) -> None:
    assert cause.value.endswith(".")
    assert Trouble(cause).text == cause.value
    assert Trouble(cause, "more").text == f"{cause.value} (more)"


def test_waiting_helps_where_room_can_come_and_a_secret_is_still_made() -> None:
    assert [cause for cause in Cause if not cause.is_final] == [Cause.NO_ROOM, Cause.CONFIG]
