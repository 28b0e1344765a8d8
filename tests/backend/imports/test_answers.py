"""The answer of the child is checked: it has read the files of strangers."""

from __future__ import annotations

import io
import json

import pytest

from backend.core.problems import StudioError
from backend.imports.answers import File, contents, read
from backend.projects.storage.spools import Spool
from tests.executor.uploads.zips import PACKAGE, zipped

UPLOAD = zipped(PACKAGE)
PREFIXES = ("robots/a/",)


def contents_of(files, upload):
    with Spool() as spool:
        found = contents(files, io.BytesIO(upload), PREFIXES, spool)
        return {path: content.data for path, content in found.items()}


def test_contents_are_taken_from_the_answer_or_the_upload():
    files = [File("robots/a/a", base64="eA=="), File("robots/a/b.stl", source="ws/cart/meshes/lid.stl")]
    found = contents_of(files, UPLOAD)
    assert found == {"robots/a/a": b"x", "robots/a/b.stl": PACKAGE["ws/cart/meshes/lid.stl"]}


def test_a_single_file_is_the_content_of_its_source(settings_of):
    """A URDF that is in the form of the importer is named by its source, too."""
    files = [File("robots/a/r.urdf", source="r.urdf")]
    assert contents_of(files, b"<robot/>") == {"robots/a/r.urdf": b"<robot/>"}
    settings_of(max_project_bytes=7)
    with pytest.raises(StudioError, match="larger than a project"):
        contents_of(files, b"<robot/>")


@pytest.mark.parametrize(
    "file",
    [
        File("robots/b/a", base64=""),
        File("robots/a/../b", base64=""),
        File("robots/a/a", base64="?"),
        File("robots/a/a", source="none"),
    ],
)
def test_a_file_elsewhere_or_without_content_is_refused(file):
    with pytest.raises(StudioError):
        contents_of([file], UPLOAD)


@pytest.mark.parametrize(
    ("answer", "code"),
    [
        (b"", "import_refused"),
        (b"[]", "import_refused"),
        (json.dumps({"name": "../x"}).encode(), "import_refused"),
        (json.dumps({"error": {"code": "too_large", "message": "x"}}).encode(), "quota_exceeded"),
        (json.dumps({"error": {"code": "bad_archive", "message": "x"}}).encode(), "bad_archive"),
        (json.dumps({"error": {"code": "choice", "message": "x"}}).encode(), "import_choice"),
    ],
)
def test_an_answer_without_a_result_is_an_error(answer, code):
    with pytest.raises(StudioError) as error:
        read(answer)
    assert error.value.code == code


def test_a_full_disk_is_one_here_and_too_large_an_upload_in_a_container(settings_of):
    answer = json.dumps({"error": {"code": "disk_full", "message": "x"}}).encode()
    with pytest.raises(OSError, match="no space"):
        read(answer)
    settings_of(launcher="docker")
    with pytest.raises(StudioError, match="more than can be unpacked"):
        read(answer)
