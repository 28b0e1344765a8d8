"""A backup holds the objects of the store; they come back to a store or to the database."""

from __future__ import annotations

import io
import random
import zipfile

import pytest

from backend.cli.shared.backup_error import BackupError
from backend.cli.shared.backup_file import read_backup, write_backup
from backend.cli.shared.backup_objects import copy_objects
from backend.core.objects.errors import StoreError
from backend.core.objects.store import the_store
from backend.projects.models import Blob, Project
from backend.projects.storage import queries as projects
from backend.projects.storage import writes
from backend.projects.storage.cache import kept_stored
from backend.projects.storage.changes import Content, FileChange
from backend.runs import queries
from backend.runs.models import Run, RunPart
from tests.backend.cli.shared.test_backup_file import empty, rewritten
from tests.backend.runs.conftest import SAMPLE, keep, manager, people

pytestmark = [pytest.mark.django_db(transaction=True), pytest.mark.usefixtures("manager")]
__all__ = ["manager", "people"]
LARGE = random.Random(6).randbytes(50_000)  # noqa: S311


@pytest.fixture
def filled(people, objects, settings_of):
    """A project with a large file and a recording, both in the store."""
    settings_of(object_store_from_bytes=1000)
    change = FileChange("a.bin", 0, Content.of(LARGE))
    project = writes.save_files(people.project.id, [change], acting_user=people.owner.user)
    assert keep(people.owner, people.project).status_code == 201
    assert len(objects.keys()) == 2
    return project


def written(**options):
    target = io.BytesIO()
    write_backup(target, **options)
    return target.getvalue()


def read(archive):
    Run.objects.all().delete()
    empty()
    kept_stored.clear()
    read_backup(io.BytesIO(archive))


def check(project):
    assert projects.current_file(project, "a.bin").data == LARGE
    run = Run.objects.get()
    assert b"".join(queries.parts(run, 0, run.size)) == SAMPLE


def test_they_come_back_under_new_names(filled, objects):
    before, archive = objects.keys(), written()
    objects.fresh()
    read(archive)
    check(filled)
    assert len(objects.keys()) == 2
    assert not objects.keys() & before


def test_they_come_back_to_a_database_without_a_store(filled, objects, settings_of):
    archive = written()
    settings_of(object_store="")
    read(archive)
    check(filled)
    assert not Blob.objects.exclude(stored_at=None).exists()
    assert RunPart.objects.count() == 1


def test_without_objects_the_bucket_must_have_them(filled, objects):
    archive = written(has_objects=False)
    assert not [name for name in zipfile.ZipFile(io.BytesIO(archive)).namelist() if "objects/" in name]
    read(archive)
    check(filled)
    objects.fresh()
    with pytest.raises(BackupError, match="copy the bucket there first"):
        read(archive)
    assert not Project.objects.exists()


def test_a_missing_or_damaged_object_ends_the_backup(filled, objects):
    key = Blob.objects.exclude(stored_at=None).get().stored_at
    objects.put(key)
    with pytest.raises(BackupError, match="--without-objects"):
        written()
    the_store().delete([key])
    with pytest.raises(BackupError, match=f"{key} is missing"):
        written()
    written(has_objects=False)


def test_a_store_that_does_not_answer_ends_it_before_anything_is_copied(filled, objects, settings_of):
    settings_of(**objects.settings | {"object_store": "http://127.0.0.1:9/studio"})
    with zipfile.ZipFile(io.BytesIO(), "w") as archive, pytest.raises(StoreError, match="cannot be reached"):
        copy_objects(archive, lambda _: None)


def test_a_damaged_backup_changes_nothing(filled, objects):
    archive, key = written(), Blob.objects.exclude(stored_at=None).get().stored_at
    damaged = {
        f"objects/{key}": lambda data: data[:-1] + b"?",
        "tables/projects.blob.jsonl": lambda data: data.replace(key.encode(), b"blobs/../x"),
    }
    with pytest.raises(BackupError, match="is not what was written"):
        read(rewritten(archive, **{f"objects/{key}": damaged[f"objects/{key}"]}))
    with pytest.raises(BackupError, match="damaged"):
        read(rewritten(archive, **{"tables/projects.blob.jsonl": damaged["tables/projects.blob.jsonl"]}))
    assert not Project.objects.exists()
