"""The zip of a project that is made part by part."""

from __future__ import annotations

import io
import zipfile

import pytest

from backend.core.scratch import scratch
from backend.projects.documents import export
from backend.projects.documents.export import Zipping, items_of, write_zip
from backend.projects.storage import queries
from backend.projects.storage.access import Need
from backend.workers import zips
from backend.workers.aside import Aside
from backend.workers.errors import BusyError


@pytest.fixture
def row(api, project, user):
    files = [{"path": f"assets/{n}.txt", "base_revision": 0, "content": str(n) * 1000} for n in range(5)]
    api.save(project["id"], *files)
    return queries.project(project["id"], user=user, need=Need.READ)


def test_parts_give_the_same_bytes_as_all_at_once(row, monkeypatch):
    expected = zips.pack(queries.contents(row))
    for size in (1, 2500, 1 << 20):
        monkeypatch.setattr(export, "PART_BYTES", size)
        file = io.BytesIO()
        write_zip(items_of(row), file)
        assert file.getvalue() == expected


def test_only_one_part_is_in_memory(row, monkeypatch):
    monkeypatch.setattr(export, "PART_BYTES", 2500)
    sizes, fetch = [], queries.data_of

    def noted(part):
        found = fetch(part)
        sizes.append(sum(map(len, found.values())))
        return found

    monkeypatch.setattr(export, "data_of", noted)
    write_zip(items_of(row), io.BytesIO())
    assert len(sizes) > 2
    assert max(sizes) <= 2500


def test_the_answer_is_that_zip_and_what_fails_leaves_no_file(api, row, monkeypatch):
    monkeypatch.setattr(export, "PART_BYTES", 1000)
    data = api.get(f"projects/{row.id}/export")
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        assert archive.testzip() is None
        assert "assets/4.txt" in archive.namelist()
    assert api.response.headers["Content-Type"] == "application/zip"
    monkeypatch.setattr(Aside, "ask", lambda *_: (_ for _ in ()).throw(BusyError("busy")))
    api.get(f"projects/{row.id}/export", expect=503)
    assert scratch().used == 0


def test_an_empty_project_is_an_empty_zip(row, monkeypatch):
    monkeypatch.setattr(export, "existing_files", lambda _: {})
    file = io.BytesIO()
    zipping = Zipping(items_of(row), file)
    assert zipping.next() is None
    assert zipfile.ZipFile(file).namelist() == []
