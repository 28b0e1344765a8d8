"""Bundles of a large project are those of a small one, and never in memory."""

from __future__ import annotations

import base64
import io
import os
import zipfile

import pytest

from backend.core.scratch import scratch
from backend.projects.documents import bundles, checking, export
from backend.projects.storage import queries, writes
from backend.projects.storage.access import Need
from backend.projects.storage.changes import Content, FileChange
from backend.workers.aside import Aside
from backend.workers.errors import BusyError

PART = 6000
LARGE = {f"assets/{n}.bin": os.urandom(5000) for n in range(4)}
FILES = {
    **LARGE,
    "assets/empty.txt": b"",
    "assets/kept.py": b"import this\n",
    "LICENSE": b"Own.\n",
    "requirements.txt": b"numpy\n",
    "robots/own/robot.yaml": b"format: bt-studio/robot\n",
    "robots/own/large.stl": os.urandom(5000),
    "universes/own.yaml": b"name: \x7fown\n",
    "launch/all.launch.xml": b'<launch><node exec="launch/talker.py"/></launch>',
    "launch/talker.py": b"import rclpy\n",
    "launch/map.pgm": os.urandom(5000),
    "actions/helper.py": b"X = 1\n",
    "tests/main.test.yaml": b"tests: []\n",
}
ZIPS = ("package", "package?name=other", "package?dockerized=true", "cpp")


@pytest.fixture
def row(api, user):
    made = api.post("projects", {"name": "Own", "template": "laser_bump_and_go"}, expect=201)
    change = [FileChange(path, 0, Content.of(data)) for path, data in FILES.items()]
    writes.save_files(made["id"], change, acting_user=user)
    maintainer = {"name": "Ada", "email": "ada@example.org"}
    settings = api.get(f"projects/{made['id']}")["settings"] | {"maintainer": maintainer}
    api.patch(f"projects/{made['id']}", {"base_revision": 2, "settings": settings})
    return queries.project(made["id"], user=user, need=Need.READ)


@pytest.fixture
def in_parts(monkeypatch):
    """No project is small, and parts have hardly more than one file; gives the sizes of what is fetched."""
    monkeypatch.setattr(bundles, "SMALL", 0)
    monkeypatch.setattr(bundles, "ENCODED", 3000)
    monkeypatch.setattr(export, "PART_BYTES", PART)
    sizes, fetch = [], queries.data_of

    def noted(part):
        found = fetch(part)
        sizes.append(sum(map(len, found.values())))
        return found

    def begin():
        sizes.clear()
        monkeypatch.setattr(export, "data_of", noted)
        return sizes

    return begin


def unzipped(data):
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        assert archive.testzip() is None
        return {name: archive.read(name) for name in archive.namelist()}


def test_a_large_package_is_that_of_a_small_one(api, row, monkeypatch, in_parts):
    old = "/tree_api/generate_app?project_name=Own"
    whole = {path: api.get(f"projects/{row.id}/{path}") for path in ZIPS}
    whole_old, names = api.get(old), {}
    for path in ZIPS:
        api.get(f"projects/{row.id}/{path}")
        names[path] = api.response.headers["Content-Disposition"]
    preview = api.get(f"projects/{row.id}/package/preview")
    sizes = in_parts()
    for path in ZIPS:
        assert api.get(f"projects/{row.id}/{path}") == whole[path]
        assert api.response.headers["Content-Disposition"] == names[path]
    assert api.get(old) == whole_old
    assert max(sizes) <= PART
    assert dict(listed(preview)) == {path: len(data) for path, data in unzipped(whole["package"]).items()}
    assert LARGE.items() <= unzipped(whole["package?dockerized=true"]).items()
    assert scratch().used == 0


def listed(preview):
    return [(file["path"], file["size"]) for file in preview["files"]]


@pytest.mark.parametrize("universe", ["own", "walled_room", ""])
def test_a_large_app_is_that_of_a_small_one(api, row, in_parts, universe):
    address = f"projects/{row.id}/app?universe={universe}"
    whole = api.get(address)
    sizes = in_parts()
    assert api.get(address) == whole
    assert api.response.headers["Content-Type"] == "application/json"
    assert max(sizes) <= PART
    assets = unzipped(base64.b64decode(whole["universe"]["assets_zip_base64"]))
    assert assets["robots/own/large.stl"] == FILES["robots/own/large.stl"]
    assert whole["universe"]["document"]
    assert scratch().used == 0


def test_only_what_the_translator_reads_is_fetched_for_it(api, row, monkeypatch, in_parts):
    in_parts()
    asked: list[str] = []
    fetch = queries.data_of

    def noted(files):
        asked.extend(file.path for file in files)
        return fetch(files)

    monkeypatch.setattr(queries, "data_of", noted)
    api.get(f"projects/{row.id}/package")
    assert not {path for path in asked if path.endswith((".bin", ".stl", ".pgm"))}
    # The packages that they name are no errors of the check.
    assert {"requirements.txt", "launch/talker.py"} <= set(asked)


def test_what_fails_leaves_no_file_and_says_why(api, row, monkeypatch, in_parts):
    in_parts()
    monkeypatch.setattr(checking, "MOST_CHECKED", 100)
    assert "that are checked" in api.get(f"projects/{row.id}/package", expect=413)["detail"]
    assert "that are checked" in api.get(f"projects/{row.id}/app", expect=413)["detail"]
    monkeypatch.undo()
    in_parts()
    monkeypatch.setattr(bundles, "SMALL", 0)
    monkeypatch.setattr(Aside, "ask", lambda *_: (_ for _ in ()).throw(BusyError("busy")))
    for path in ("app", *ZIPS):
        api.get(f"projects/{row.id}/{path}", expect=503)
    assert scratch().used == 0


def test_a_refused_project_says_its_problems(api, row, in_parts):
    in_parts()
    tree = '{"id": "MainTree", "root": "n1", "nodes": {"n1": {"type": "Nope"}}}'
    api.save(row.id, {"path": "trees/MainTree.json", "base_revision": row.revision, "content": tree})
    for path in ("app", *ZIPS, "package/preview"):
        assert api.get(f"projects/{row.id}/{path}", expect=422)["diagnostics"]
