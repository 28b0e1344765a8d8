"""The watch over pods: it hears all, and begins again when it was broken or too old."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from backend.sessions.launchers.base import UNKNOWN_EXIT
from backend.sessions.launchers.kubernetes import objects as module
from backend.sessions.launchers.kubernetes.bodies import Kind, pod_name
from tests.backend.sessions.conftest import spec

if TYPE_CHECKING:
    import pytest

    from backend.sessions.launchers.kubernetes.ends import Seen
    from backend.sessions.launchers.kubernetes.launcher import KubernetesLauncher
    from tests.fakes.kubernetes_api import FakeCluster

NAME = pod_name(Kind.SESSION, "s1")


def soon() -> float:
    return time.monotonic() + 20


def has_ended(seen: Seen | None) -> bool:
    return seen is not None and seen.exit_status is not None


def test_a_watch_that_is_too_old_begins_again_and_misses_no_end(
    cluster: FakeCluster, launcher: KubernetesLauncher
) -> None:
    launcher.start(spec())
    launcher.start(spec(session_id="s2"))
    cluster.drop_silently(NAME)
    cluster.forget_history()
    seen, ended = launcher._pods.wait(NAME, has_ended, soon())
    assert ended
    assert seen is not None
    assert seen.exit_status == UNKNOWN_EXIT
    cluster.remove("pods", pod_name(Kind.SESSION, "s2"))  # the new watch hears this
    assert launcher._pods.wait(pod_name(Kind.SESSION, "s2"), has_ended, soon())[1]
    assert [verb for verb, _ in cluster.asked].count("list") >= 2


def test_what_is_asked_while_the_cluster_is_silent_is_answered_at_once(
    cluster: FakeCluster, launcher: KubernetesLauncher
) -> None:
    started = launcher.start(spec())
    cluster.die()
    assert launcher._pods.get(started.state["pod"]) is not None
    assert launcher._pods.wait(NAME, has_ended, time.monotonic()) == (launcher._pods.get(NAME), False)


def test_the_ends_of_many_pods_do_not_fill_the_memory(
    cluster: FakeCluster, launcher: KubernetesLauncher, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "MOST_ENDED", 2)
    for number in range(4):
        name = pod_name(Kind.SESSION, f"n{number}")
        launcher.start(spec(session_id=f"n{number}"))
        cluster.remove("pods", name)
        assert launcher._pods.wait(name, has_ended, soon())[1]
    assert [number for number in range(4) if launcher._pods.get(pod_name(Kind.SESSION, f"n{number}"))] == [
        2,
        3,
    ]


def test_an_end_that_is_awaited_when_the_server_ends_is_not_awaited_longer(
    launcher: KubernetesLauncher,
) -> None:
    launcher._pods._closing.set()
    assert launcher._pods.wait(NAME, has_ended, soon()) == (None, False)
