"""A content without references goes after a day; one that is referenced again stays, whenever it happens."""

from __future__ import annotations

import base64
import random
from contextlib import contextmanager
from datetime import timedelta

import pytest
from django.utils import timezone

from backend.core.objects.store import the_store
from backend.projects.models import Blob, Project
from backend.projects.storage import blobs, collection, writes
from backend.projects.storage.cache import kept_stored
from backend.projects.storage.changes import Content, FileChange

LARGE = random.Random(3).randbytes((1 << 20) + 1)  # noqa: S311
SHA256 = Content.of(LARGE).sha256
DAY = timedelta(hours=24)


@pytest.fixture
def gone(api, objects):
    """A large content whose project was deleted for good; returns the name of its object."""
    project = api.post("projects", {"name": "Gone"}, expect=201)
    file = {"path": "a.bin", "base_revision": 0, "content_base64": base64.b64encode(LARGE).decode()}
    api.save(project["id"], file)
    Project.objects.filter(id=project["id"]).delete()
    kept_stored.clear()
    return Blob.objects.get(sha256=SHA256).stored_at


def collect(hours):
    """Collects at a time from now on; objects are as old as the store says."""
    return collection.collect(the_store(), now=timezone.now() + timedelta(hours=hours))


def row():
    return Blob.objects.filter(sha256=SHA256).first()


def use_again(user):
    project = writes.create_project({}, acting_user=user, name="Again")
    change = FileChange("b.bin", 0, Content.of(LARGE))
    return writes.save_files(project.id, [change], acting_user=user)


def test_it_is_noted_marked_after_a_day_and_deleted_with_its_object(gone, objects):
    writes.collect_garbage(now=timezone.now() + timedelta(days=400))
    assert collect(0) == (0, 0, 0)
    assert row().unreferenced_at is not None
    assert collect(23) == (0, 0, 0)
    assert objects.keys() == {gone}
    assert collect(25) == (1, 1, 0)
    assert row() is None
    assert objects.keys() == set()


def test_one_that_is_used_again_stays_and_its_day_begins_again(gone, objects, user):
    collect(0)
    project = use_again(user)
    assert collect(25) == (0, 0, 0)
    assert (row().unreferenced_at, row().marked_at) == (None, None)
    Project.objects.filter(id=project.id).delete()
    assert collect(26) == (0, 0, 0)
    assert collect(49) == (0, 0, 0)
    assert objects.keys() == {gone}
    assert collect(51) == (1, 1, 0)


def test_one_that_is_used_after_its_mark_stays(gone, objects, user):
    collect(0)
    assert collection.mark(timezone.now() + DAY) == 1
    project = use_again(user)
    key = row().stored_at
    assert key != gone
    assert row().marked_at is None
    assert collection.delete(the_store()) == 0
    assert project.now["b.bin"].sha256 == SHA256
    # The object that it had before has no row any more.
    assert collect(25).swept == 1
    assert objects.keys() == {key}


def test_one_that_is_referenced_between_mark_and_deletion_stays(gone, objects, user, monkeypatch):
    """The writer looked before the mark, and so uploads nothing."""
    collect(0)
    placed = blobs.placed

    @contextmanager
    def marked_meanwhile(*args):
        with placed(*args) as uploaded:
            assert not uploaded
            collection.mark(timezone.now() + DAY)
            yield uploaded

    project = writes.create_project({}, acting_user=user, name="Again")
    monkeypatch.setattr(blobs, "placed", marked_meanwhile)
    writes.save_files(project.id, [FileChange("b.bin", 0, Content.of(LARGE))], acting_user=user)
    assert row().marked_at is not None
    assert collection.delete(the_store()) == 0
    assert (row().stored_at, objects.keys()) == (gone, {gone})
    collect(1)
    assert row().marked_at is None


def test_a_kill_between_row_and_object_leaves_an_object_that_is_swept(gone, objects, monkeypatch):
    collect(0)
    collection.mark(timezone.now() + DAY)
    assert collection.delete_rows([SHA256]) == [gone]  # and here the process is killed
    assert objects.keys() == {gone}
    assert collect(23).swept == 0
    assert collect(25).swept == 1
    assert objects.keys() == set()


def test_what_is_in_the_database_is_not_collected_here(api, project, objects):
    rows = Blob.objects.count()
    collect(0)
    collect(48)
    assert Blob.objects.count() == rows
    assert not Blob.objects.exclude(unreferenced_at=None).exists()
