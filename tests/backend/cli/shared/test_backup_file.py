"""Backups: all data are restored; a damaged or foreign file is refused without any change."""

from __future__ import annotations

import io
import json
import zipfile

import pytest

from backend.cli.shared import backup_file
from backend.cli.shared.backup_error import BackupError
from backend.cli.shared.backup_file import LEFT_OUT, MANIFEST, read_backup, write_backup
from backend.projects.models import Blob, Project
from translator.unzip import Limits

pytestmark = pytest.mark.django_db(transaction=True)


@pytest.fixture
def archive(api, project):
    """A backup of one project with two revisions, text and bytes."""
    change = {
        "files": [
            {"path": "assets/ñ.bin", "content_base64": "AP8Q", "base_revision": 0},
            {"path": "assets/note.txt", "content": "one\ntwo", "base_revision": 0},
        ]
    }
    api.post(f"projects/{project['id']}/changes", change)
    buffer = io.BytesIO()
    counts = write_backup(buffer)
    assert counts["projects.project"] == 1
    assert not LEFT_OUT & set(counts)
    return buffer.getvalue()


def empty():
    Project.objects.all().delete()
    Blob.objects.all().delete()


def rewritten(archive, **changes):
    """The backup with other members."""
    target = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(archive)) as old, zipfile.ZipFile(target, "w") as new:
        for name in old.namelist():
            change = changes.get(name, lambda data: data)
            new.writestr(name, change(old.read(name)))
    return target.getvalue()


def test_everything_comes_back(api, project, archive):
    files = api.get(f"projects/{project['id']}")["files"]
    revisions = api.get(f"projects/{project['id']}/revisions")
    empty()
    counts = read_backup(io.BytesIO(archive))
    assert counts["projects.changeset"] == 2
    assert api.get(f"projects/{project['id']}")["files"] == files
    assert api.get(f"projects/{project['id']}/revisions") == revisions
    # New rows get new numbers.
    api.post("projects", {"name": "After"}, expect=201)


def test_a_server_with_projects_takes_no_backup(archive):
    with pytest.raises(BackupError, match="empty server"):
        read_backup(io.BytesIO(archive))


def test_a_damaged_backup_changes_nothing(archive):
    empty()
    for name, change, says in (
        ("tables/projects.blob.jsonl", lambda data: data[:-9], "damaged"),
        (MANIFEST, lambda data: data.replace(b'"bt-studio/backup"', b'"other"'), "no backup"),
        (MANIFEST, lambda data: data[:-1], "no manifest"),
        (MANIFEST, lambda data: json.dumps(json.loads(data) | {"migrations": []}).encode(), "that version"),
    ):
        with pytest.raises(BackupError, match=says):
            read_backup(io.BytesIO(rewritten(archive, **{name: change})))
    for nonsense in (b"", b"no zip", archive[: len(archive) // 2]):
        with pytest.raises(BackupError, match="no readable backup"):
            read_backup(io.BytesIO(nonsense))
    assert not Project.objects.exists()


def test_a_backup_with_too_many_names_is_refused_before_they_are_read(archive, monkeypatch):
    empty()
    small = Limits(directory_bytes=1 << 20, entries=3)
    monkeypatch.setattr(backup_file, "LIMITS", small)
    with pytest.raises(BackupError, match="more than 3 entries"):
        read_backup(io.BytesIO(archive))
    with pytest.raises(BackupError, match="--without-objects"):
        write_backup(io.BytesIO())
    write_backup(io.BytesIO(), has_objects=False)


def test_a_manifest_or_row_that_never_ends_is_refused(archive, monkeypatch):
    empty()
    monkeypatch.setattr(backup_file, "MAX_MANIFEST_BYTES", 100)
    with pytest.raises(BackupError, match="more than 100 bytes"):
        read_backup(io.BytesIO(archive))
    monkeypatch.undo()
    monkeypatch.setattr(backup_file, "MAX_LINE_BYTES", 50)
    with pytest.raises(BackupError, match="too long"):
        read_backup(io.BytesIO(archive))
