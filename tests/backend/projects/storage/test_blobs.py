"""Large contents are in the object store, small ones in the database; each is read from where it is."""

from __future__ import annotations

import base64
import random
from contextlib import contextmanager

import pytest
from django.db import connection
from django.test.utils import CaptureQueriesContext

from backend.core.objects.errors import StoreError
from backend.core.objects.store import the_store
from backend.projects.errors import QuotaExceededError
from backend.projects.models import Blob, Project
from backend.projects.storage import blobs, queries, writes
from backend.projects.storage.cache import kept_stored
from backend.projects.storage.changes import Content, FileChange

MEBIBYTE = 1 << 20
LARGE = random.Random(1).randbytes(MEBIBYTE + 1)  # noqa: S311
OTHER = random.Random(2).randbytes(MEBIBYTE + 2)  # noqa: S311


def change(path, data, base=0):
    return {"path": path, "base_revision": base, "content_base64": base64.b64encode(data).decode()}


def stored(data):
    """The row of a content."""
    return Blob.objects.filter(sha256=Content.of(data).sha256).first()


def test_a_large_file_is_an_object_and_a_small_one_a_row(api, project, objects):
    api.save(project["id"], change("large.bin", LARGE), change("small.bin", LARGE[:MEBIBYTE]))
    large, small = stored(LARGE), stored(LARGE[:MEBIBYTE])
    assert (large.data, large.size) == (None, len(LARGE))
    assert objects.keys() == {large.stored_at}
    assert (small.stored_at, bytes(small.data)) == (None, LARGE[:MEBIBYTE])
    for path, data in (("large.bin", LARGE), ("small.bin", LARGE[:MEBIBYTE])):
        assert api.get(f"projects/{project['id']}/files/{path}") == data
        assert api.get(f"projects/{project['id']}/revisions/2/files/{path}") == data


def test_a_content_that_is_there_is_not_uploaded_again(api, project, objects):
    api.save(project["id"], change("a.bin", LARGE))
    key = stored(LARGE).stored_at
    api.save(project["id"], change("b.bin", LARGE))
    copy = api.post(f"projects/{project['id']}/duplicate", {"name": "Copy"}, expect=201)
    api.post(f"projects/{project['id']}/revisions/2/restore", {})
    assert objects.keys() == {key}
    assert api.get(f"projects/{copy['id']}/files/a.bin") == LARGE


def test_a_marked_content_is_uploaded_again(api, project, objects, user):
    api.save(project["id"], change("a.bin", LARGE))
    before = stored(LARGE)
    Blob.objects.filter(pk=before.pk).update(marked_at=before.marked_at or "2026-01-01T00:00:00Z")
    api.save(project["id"], change("b.bin", LARGE))
    after = stored(LARGE)
    assert (after.marked_at, after.unreferenced_at) == (None, None)
    assert after.stored_at != before.stored_at
    assert objects.keys() == {before.stored_at, after.stored_at}  # the first one is swept later
    assert api.get(f"projects/{project['id']}/files/b.bin") == LARGE


def test_a_content_that_goes_meanwhile_is_stored_with_its_save(api, project, objects, monkeypatch, user):
    """Its row was there when the save began, and is not any more when it writes."""
    gone = writes.create_project({"a.bin": LARGE}, acting_user=user, name="Gone")
    placed = blobs.placed

    @contextmanager
    def collected_meanwhile(*args):
        with placed(*args) as uploaded:
            assert not uploaded
            Project.objects.filter(id=gone.id).delete()
            Blob.objects.filter(sha256=Content.of(LARGE).sha256).delete()
            yield uploaded

    monkeypatch.setattr(blobs, "placed", collected_meanwhile)
    writes.save_files(project["id"], [FileChange("b.bin", 0, Content.of(LARGE))], acting_user=user)
    assert bytes(stored(LARGE).data) == LARGE


def test_what_is_refused_leaves_nothing(api, project, objects, settings_of):
    api.save(project["id"], change("a.bin", LARGE))
    keys = objects.keys()
    api.save(project["id"], change("a.bin", OTHER), expect=409)
    settings_of(**objects.settings, max_user_bytes=2 * MEBIBYTE)
    api.save(project["id"], change("b.bin", OTHER), expect=413)
    api.post("projects/none", expect=404)
    settings_of(**objects.settings, max_file_bytes=MEBIBYTE)
    api.save(project["id"], change("b.bin", OTHER), expect=413)
    assert objects.keys() == keys
    assert stored(OTHER) is None


def test_nobody_uploads_who_may_not_write(api, objects, user, settings_of):
    files = {"a.bin": LARGE}
    settings_of(**objects.settings, max_user_projects=1)
    writes.create_project(files, acting_user=user, name="One")
    keys = objects.keys()
    assert len(keys) == 1
    with pytest.raises(QuotaExceededError):
        writes.create_project({"a.bin": OTHER}, acting_user=user, name="Two")
    assert objects.keys() == keys


def test_where_no_store_is_set_a_save_asks_the_database_as_often(api, project, objects, settings_of):
    def asked(path):
        with CaptureQueriesContext(connection) as queries_:
            api.save(project["id"], change(path, LARGE))
        return len(queries_)

    settings_of()
    for variable in objects.variables:
        settings_of(**{variable.removeprefix("BT_STUDIO_").lower(): ""})
    plain = asked("a.bin")
    assert bytes(stored(LARGE).data) == LARGE
    with CaptureQueriesContext(connection) as queries_:
        api.save(project["id"], change("b.bin", b"small"))
    settings_of(**objects.settings)
    with CaptureQueriesContext(connection) as with_store:
        api.save(project["id"], change("c.bin", b"small too"))
    assert len(with_store) == len(queries_) == plain


def test_a_store_that_is_only_read_takes_nothing(api, project, objects, settings_of):
    api.save(project["id"], change("a.bin", LARGE))
    settings_of(**objects.settings, object_store_writes="false")
    api.save(project["id"], change("b.bin", OTHER))
    assert bytes(stored(OTHER).data) == OTHER
    assert api.get(f"projects/{project['id']}/files/a.bin") == LARGE


def test_a_row_that_moved_is_read_where_it_is_now(api, project, objects):
    api.save(project["id"], change("a.bin", LARGE))
    row = stored(LARGE)
    key, sha256 = row.stored_at, row.sha256
    Blob.objects.filter(pk=sha256).update(stored_at=None, data=LARGE)
    the_store().delete([key])
    assert blobs.bytes_of(sha256, None, key) == LARGE
    Blob.objects.filter(pk=sha256).update(stored_at="blobs/none", data=None)
    with pytest.raises(StoreError, match="missing"):
        blobs.bytes_of(sha256, None, "blobs/none")


def test_a_store_that_does_not_answer_refuses_the_save_and_says_so(api, project, objects, settings_of):
    api.save(project["id"], change("a.bin", LARGE))
    kept_stored.clear()
    settings_of(**objects.settings | {"object_store": "http://127.0.0.1:9/studio"})
    answer = api.save(project["id"], change("b.bin", OTHER), expect=503)
    assert answer["code"] == "object_store_unavailable"
    assert "http://127.0.0.1:9" in answer["detail"]
    assert stored(OTHER) is None
    assert api.get(f"projects/{project['id']}/files/a.bin", expect=503)["code"] == answer["code"]
    api.save(project["id"], change("small.txt", b"small"))


def test_trees_in_the_store_are_searched_for_offers(api, project, objects, user):
    files = [
        change("trees/Big.json", b'{"attributes": {"_offered": "1"}, "x": "' + LARGE.hex().encode() + b'"}')
    ]
    api.save(project["id"], *files)
    assert queries.current_file(queries.project_named("Robot", user=user), "trees/Big.json").text
    api.get("projects/offers")
