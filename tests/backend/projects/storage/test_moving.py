"""Contents move to the store and back, whatever interrupts it, and are read at either place."""

from __future__ import annotations

import base64
import random

import pytest

from backend.core.objects.errors import StoreError
from backend.core.objects.store import the_store
from backend.projects.models import Blob
from backend.projects.storage.cache import kept_stored
from backend.projects.storage.moving import movable, move_back, move_out, moved

FILES = {f"{n}.bin": random.Random(n).randbytes((1 << 20) + n) for n in range(1, 4)}  # noqa: S311


@pytest.fixture
def filled(api, project, objects, settings_of):
    """Three large files in the database, from before the store was set."""
    settings_of(object_store="")
    wanted = [
        {"path": path, "base_revision": 0, "content_base64": base64.b64encode(data).decode()}
        for path, data in FILES.items()
    ]
    api.save(project["id"], *wanted)
    settings_of(**objects.settings)
    return project["id"]


def read(api, project):
    kept_stored.clear()
    return {path: api.get(f"projects/{project}/files/{path}") for path in FILES}


def test_they_move_out_one_by_one_and_back(api, filled, objects):
    moving = move_out(the_store())
    assert next(moving) in {len(data) for data in FILES.values()}
    del moving  # interrupted
    assert (movable().count(), moved().count(), len(objects.keys())) == (2, 1, 1)
    assert read(api, filled) == FILES
    assert len(list(move_out(the_store()))) == 2
    assert (movable().count(), len(objects.keys())) == (0, 3)
    assert read(api, filled) == FILES
    back = move_back(the_store())
    next(back)
    del back
    assert read(api, filled) == FILES
    assert len(list(move_back(the_store()))) == 2
    assert not moved().exists()
    assert read(api, filled) == FILES
    assert len(objects.keys()) <= 1  # the one of the interrupted move may wait for the sweep


def test_two_at_once_move_each_once(api, filled, objects):
    first, second = move_out(the_store()), move_out(the_store())
    sizes = [next(first), next(second), *first, *second]
    assert sorted(sizes) == sorted(map(len, FILES.values()))
    assert objects.keys() == set(moved().values_list("stored_at", flat=True))


def test_one_that_changes_while_it_is_uploaded_is_left(filled, objects, monkeypatch):
    put = the_store().put

    def late(key, file, size, sha256):
        put(key, file, size, sha256)
        Blob.objects.filter(sha256=sha256).update(stored_at="elsewhere", data=None)

    monkeypatch.setattr(the_store(), "put", late)
    assert list(move_out(the_store())) == []
    assert objects.keys() == set()


def test_a_damaged_object_is_not_moved_back(filled, objects):
    list(move_out(the_store()))
    key = moved().order_by("sha256").first().stored_at
    objects.put(key)
    with pytest.raises(StoreError, match="is not what was stored"):
        list(move_back(the_store()))
    assert moved().filter(stored_at=key).exists()
    assert {key} <= objects.keys()
