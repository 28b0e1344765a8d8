"""The files that an executor gets."""

from __future__ import annotations

import base64
import io
import zipfile

from backend.evaluations.bundle import archive_of
from backend.projects.storage import writes as projects
from backend.projects.storage.changes import Content, FileChange
from tests.backend.evaluations.conftest import wish


def files_in(archive: str) -> dict[str, bytes]:
    with zipfile.ZipFile(io.BytesIO(base64.b64decode(archive))) as found:
        return {name: found.read(name) for name in found.namelist()}


def test_the_older_version_runs_in_the_worlds_of_the_newer_one(people):
    change = [
        FileChange("universes/own.yaml", 1, Content.of(b"new")),
        FileChange("trees/MainTree.json", 1, Content.of(b'{"new": 1}')),
    ]
    projects.save_files(people.project.id, change, acting_user=people.owner.user)
    found = wish(people)
    assert found.revision == 2
    newer, older = files_in(archive_of(found, 2)), files_in(archive_of(found, 1))
    assert (newer["universes/own.yaml"], newer["trees/MainTree.json"]) == (b"new", b'{"new": 1}')
    assert (older["universes/own.yaml"], older["trees/MainTree.json"]) == (b"new", b"{}")
