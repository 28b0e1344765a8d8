"""Objects without a row go after a day, and no others."""

from __future__ import annotations

from datetime import timedelta

from django.utils import timezone

from backend.core.objects import sweep as sweeping
from backend.core.objects.store import the_store
from backend.core.objects.sweep import sweep


def test_only_old_objects_of_the_folder_without_a_row_go(objects, monkeypatch):
    monkeypatch.setattr(sweeping, "AT_ONCE", 2)
    names = [f"blobs/{number}/x" for number in range(5)]
    for name in (*names, "runs/1/x"):
        objects.put(name)
    looked: list[int] = []

    def run(hours):
        now = timezone.now() + timedelta(hours=hours)
        return sweep(the_store(), "blobs/", lambda keys: {names[3]} & set(keys), now=now, told=looked.append)

    assert run(23) == 0
    assert run(25) == 4
    assert objects.keys() == {names[3], "runs/1/x"}
    assert looked == [2, 4, 5, 2, 4, 5]
