"""Files that are taken from a project."""

from __future__ import annotations

import io
import zipfile

from backend.core.file_answers import saved_as
from backend.projects.api.views_files import download


def test_a_file_and_the_whole_project_are_downloaded(api, project):
    one = project["id"]
    raw = api.client.get(f"/api/v1/projects/{one}/export").getvalue()
    with zipfile.ZipFile(io.BytesIO(raw)) as archive:
        assert "project.json" in archive.namelist()
    assert api.get(f"projects/{one}/files/no.txt", expect=404)["code"] == "not_found"


def test_a_download_has_the_name_of_its_file():
    answer = download(b"x", "text/plain", "größe.txt")
    assert "attachment" in answer.headers["Content-Disposition"]
    assert saved_as("a.txt")
