"""The files that an executor gets."""

from __future__ import annotations

import base64
import io
import json
import os
import zipfile
from typing import IO

import pytest

from backend.core.scratch import scratch
from backend.evaluations import bundle
from backend.evaluations.bundle import archive_of, message_with
from backend.projects.documents import export
from backend.projects.errors import QuotaExceededError
from backend.projects.storage import queries
from backend.projects.storage import writes as projects
from backend.projects.storage.changes import Content, FileChange
from executor.manager.server import MAX_COMMAND_BYTES
from tests.backend.evaluations.conftest import wish


def files_in(archive: IO[bytes]) -> dict[str, bytes]:
    with archive, zipfile.ZipFile(archive) as found:
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


def test_of_a_large_project_one_part_at_a_time_is_in_memory(people, monkeypatch):
    large = {f"assets/{n}.bin": os.urandom(1000) for n in range(5)}
    change = [FileChange(path, 0, Content.of(data)) for path, data in large.items()]
    projects.save_files(people.project.id, change, acting_user=people.owner.user)
    monkeypatch.setattr(export, "PART_BYTES", 2500)
    monkeypatch.setattr(bundle, "PART", 999)
    sizes, fetch = [], queries.data_of

    def noted(part):
        found = fetch(part)
        sizes.append(sum(map(len, found.values())))
        return found

    monkeypatch.setattr(export, "data_of", noted)
    found = wish(people)
    message = {"id": "a", "data": {"job": "b"}}
    with archive_of(found, found.revision) as archive:
        parts = list(message_with(archive, message))
    assert max(sizes) <= 2500
    assert max(map(len, parts[1:])) <= 4 * 999 // 3
    told = json.loads("".join(parts))
    packed = base64.b64decode(told["data"].pop("app_zip_base64"))
    assert told == message
    assert large.items() <= files_in(io.BytesIO(packed)).items()


def test_what_an_executor_does_not_take_is_refused_before_it_is_sent(people, monkeypatch):
    assert 4 * bundle.MOST_PACKED / 3 < MAX_COMMAND_BYTES
    monkeypatch.setattr(bundle, "MOST_PACKED", 100)
    found = wish(people)
    with pytest.raises(QuotaExceededError, match="a session takes"):
        archive_of(found, found.revision)
    assert scratch().used == 0
