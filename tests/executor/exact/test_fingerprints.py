"""Fingerprints of ticks differ where runs differ."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from executor.exact.fingerprints import Fingerprints
from executor.replay_messages import FINGERPRINT_BYTES
from tests.fakes.hostile_values import VALUES
from tree_gardener import BlackboardChange, Status
from tree_gardener.observe import TickChanges


def prints_of(
    *, x: float = 0.0, time_s: float = 1.0, status: Status = Status.RUNNING, value: Any = 1
) -> bytes:
    poses = np.array([[x, 0.0]], dtype=np.float32)
    world: Any = SimpleNamespace(
        time_s=time_s, robots=[SimpleNamespace(pose=(x, 0.0, 0.0))], read_poses=lambda: lambda: poses
    )
    observers: list[Any] = []
    tree: Any = SimpleNamespace(observe=observers.append)
    fingerprints = Fingerprints(world)
    fingerprints.follow(tree)
    entry = BlackboardChange("", "k", type(value).__name__, value, removed=False, writer_uid=1)
    observers[0](TickChanges(1, [(1, status)], [], [entry], 0.1 * time_s))
    first = fingerprints.take()
    assert fingerprints.take() != first  # what was taken does not count again
    return first


def test_equal_ticks_have_equal_ones():
    first = prints_of()
    assert len(first) == FINGERPRINT_BYTES
    assert prints_of() == first


def test_each_part_counts():
    others = {
        prints_of(x=1e-6),
        prints_of(time_s=1.1),
        prints_of(status=Status.SUCCESS),
        prints_of(value=2),
        prints_of(value=True),
        prints_of(value="1"),
    }
    assert len(others) == 6
    assert prints_of() not in others


def test_the_order_of_changes_does_not_count():
    """An observer that begins late, as a recording does, changes the order in the next tick."""
    robots: list[Any] = []
    world: Any = SimpleNamespace(time_s=1.0, robots=robots, read_poses=lambda: lambda: np.zeros(1))
    found = set()
    for order in (1, -1):
        observers: list[Any] = []
        tree: Any = SimpleNamespace(observe=observers.append)
        fingerprints = Fingerprints(world)
        fingerprints.follow(tree)
        changed = [(1, Status.RUNNING), (2, Status.SUCCESS)][::order]
        entries = [BlackboardChange("", key, "int", 1, removed=False, writer_uid=1) for key in "ab"][::order]
        observers[0](TickChanges(1, changed, [], entries, 0.1))
        found.add(fingerprints.take())
    assert len(found) == 1


def test_a_value_without_a_plain_form_counts_by_its_type():
    assert prints_of(value=object()) == prints_of(value=object())
    assert prints_of(value=[1]) != prints_of(value={})


@pytest.mark.parametrize("number", range(len(VALUES)))
def test_any_value_has_a_fingerprint_without_a_method_of_its_class(number: int) -> None:
    assert len(prints_of(value=VALUES[number])) == FINGERPRINT_BYTES


def test_numbers_of_numpy_and_large_ones_count_by_their_value() -> None:
    assert prints_of(value=np.float64(1.5)) != prints_of(value=np.float64(2.5))
    assert prints_of(value=10**6_000) != prints_of(value=10**6_000 + 1)
