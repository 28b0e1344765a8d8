"""Which names projects and files may have."""

from __future__ import annotations

import io
import unicodedata
import zipfile

import pytest
from hypothesis import given
from hypothesis import strategies as st

from backend.core.problems import InvalidInputError
from backend.projects.storage import names


@pytest.mark.parametrize(
    "path",
    [
        "project.json",
        "actions/Forward.py",
        "assets/карта.png",
        "a b/c d.txt",
        ".env",
        "x/.hidden",
        "日本/語.md",
        "می‌خواهم.py",
    ],
)
def test_good_paths(path):
    assert names.file_path(path) == unicodedata.normalize("NFC", path)


@pytest.mark.parametrize(
    "path",
    [
        "",
        "/etc/passwd",
        "../x",
        "a/../b",
        "a//b",
        "a/./b",
        "a/",
        "C:/x",
        "C:\\x",
        "a\\b",
        "a\0b",
        "a\nb",
        "con",
        "CON.txt",
        "a/nul",
        "ＣＯＮ",
        "lpt1.py",
        "a.",
        "a ",
        " a",
        "a/ b",
        "x\u202ey",
        "\ufeffx",
        "\ud800",
        "a" * 201,
        "a/" * 20 + "b",
        "x" * 401,
        "a*b",
        "a?b",
        'a"b',
        "<x>",
        "a|b",
        "COM1 .txt",
    ],
)
def test_bad_paths(path):
    with pytest.raises(InvalidInputError) as caught:
        names.file_path(path)
    assert caught.value.field == "path"
    caught.value.detail.encode()


@given(st.text())
def test_an_accepted_path_stays_below_its_folder_and_is_stable(text):
    try:
        path = names.file_path(text)
    except InvalidInputError:
        return
    assert names.file_path(path) == path
    assert not path.startswith("/")
    assert ".." not in path.split("/")
    assert "\\" not in path
    path.encode()


@pytest.mark.parametrize("name", ["Robot", "Роботы", "a.b", "x (2)", "🤖"])
def test_good_names(name):
    assert names.project_name(f"  {name} ") == name


@pytest.mark.parametrize("name", ["", "  ", ".", "..", "a/b", "a\\b", "a\nb", "\u202e", "x" * 101, "a\0"])
def test_bad_names(name):
    with pytest.raises(InvalidInputError):
        names.project_name(name)


@pytest.mark.parametrize(
    ("one", "other"), [("Straße", "STRASSE"), ("é", "e\u0301"), ("ﬁle", "FILE"), ("A", "a")]
)
def test_names_that_a_disk_may_confuse_have_one_key(one, other):
    assert names.key(one) == names.key(other)


def test_a_free_name_counts_up_and_keeps_its_length():
    assert names.free_name("Robot", set()) == "Robot"
    assert names.free_name("Robot", {"robot", "robot 2"}) == "Robot 3"
    long = "x" * names.MAX_NAME_LENGTH
    free = names.free_name(long, {names.key(long)})
    assert len(free) <= names.MAX_NAME_LENGTH
    assert free.endswith(" 2")


@pytest.mark.django_db(transaction=True)
def test_folders_of_tools_can_neither_be_written_nor_renamed_to(api):
    one = api.post("projects", {"name": "Robot"}, expect=201)["id"]
    api.save(one, {"path": "lib/a.txt", "base_revision": 0, "content": "x"})
    for path in (".git/config", "lib/.GIT/hooks/post-checkout", ".vscode/tasks.json", ".git", "git~1/x"):
        refused = api.save(one, {"path": path, "base_revision": 0, "content": "x"}, expect=422)
        assert "for tools" in refused["detail"]
        api.save(one, {"path": "lib/a.txt", "base_revision": 2, "rename_to": path}, expect=422)
        api.put(f"projects/{one}/drafts/{path}", {"base_revision": 0, "content": ""}, expect=422)
    api.save(one, {"path": ".gitignore", "base_revision": 0, "content": "x"})


@pytest.mark.django_db(transaction=True)
def test_what_an_older_version_let_in_stays_here_and_can_be_taken_out(api, monkeypatch):
    one = api.post("projects", {"name": "Robot"}, expect=201)["id"]
    with monkeypatch.context() as older:
        older.setattr(names, "is_of_tool", lambda path: False)
        api.save(one, {"path": ".git/config", "base_revision": 0, "content": "x"})
    assert ".git/config" in {each["path"] for each in api.get(f"projects/{one}")["files"]}
    exported = zipfile.ZipFile(io.BytesIO(api.get(f"projects/{one}/export")))
    assert ".git/config" not in exported.namelist()
    copy = api.post(f"projects/{one}/duplicate", expect=201)
    assert ".git/config" not in {each["path"] for each in copy["files"]}
    api.save(one, {"path": ".git/config", "base_revision": 2, "delete": True})
    back = api.post(f"projects/{one}/revisions/2/restore")
    assert ".git/config" not in {each["path"] for each in back["files"]}


@pytest.mark.django_db(transaction=True)
def test_an_import_leaves_folders_of_tools_out(api):
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as packed:
        packed.writestr("Robot/project.json", "{}")
        for path in (".git/config", ".vscode/tasks.json", "assets/.git/HEAD", "assets/a.txt"):
            packed.writestr(f"Robot/{path}", "x")
    stream.seek(0)
    stream.name = "Robot.zip"
    made = api.client.post("/api/v1/projects/import", {"file": stream}).json()
    assert {each["path"] for each in made["files"]} == {"project.json", "assets/a.txt"}
