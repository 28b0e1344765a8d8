"""Recordings move to the store and back."""

from __future__ import annotations

import pytest

from backend.core.objects.errors import StoreError
from backend.core.objects.store import the_store
from backend.runs import queries
from backend.runs.models import Run, RunPart
from backend.runs.moving import movable, move_back, move_out, moved
from tests.backend.runs.conftest import SAMPLE, keep

pytestmark = pytest.mark.usefixtures("manager")


@pytest.fixture
def kept(people, objects, settings_of):
    """Two recordings in the database."""
    for name in ("a", "b"):
        keep(people.owner, people.project, name=name)
    settings_of(**objects.settings, object_store_from_bytes=0)
    assert movable().count() == 2
    return objects


def read():
    return [b"".join(queries.parts(run, 0, run.size)) for run in Run.objects.all()]


def test_they_move_out_and_back(kept):
    moving = move_out(the_store())
    next(moving)
    assert read() == [SAMPLE] * 2
    assert len(list(moving)) == 1
    assert (RunPart.objects.count(), moved().count(), len(kept.keys())) == (0, 2, 2)
    assert read() == [SAMPLE] * 2
    assert list(move_back(the_store())) == [len(SAMPLE)] * 2
    assert (moved().count(), kept.keys()) == (0, set())
    assert read() == [SAMPLE] * 2


def test_one_that_is_deleted_meanwhile_is_passed_over(kept):
    moving = move_out(the_store())
    next(moving)
    movable().delete()
    assert list(moving) == []
    back = move_back(the_store())
    moved().delete()
    assert list(back) == []


def test_a_damaged_object_is_not_moved_back(kept):
    list(move_out(the_store()))
    kept.put(moved().order_by("id").first().stored_at)
    with pytest.raises(StoreError, match="is not what was stored"):
        list(move_back(the_store()))
    assert moved().count() == 2
