"""Foreign zips and folders: paths that leave the project and zip bombs are refused, with a place."""

from __future__ import annotations

import io
import stat
import zipfile
from pathlib import Path

import pytest

from translator import TranslatorError, archive, load, to_app_zip, to_ros2_package
from translator.archive import read_folder, read_zip, safe_path
from translator.foreign import is_of_tool

ROOT = Path(__file__).parents[2]


def zipped(entries):
    target = io.BytesIO()
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as made:
        for name, data in entries:
            made.writestr(name, data)
    return target.getvalue()


def refused(raw):
    with pytest.raises(TranslatorError) as error:
        read_zip(raw, file="p.zip")
    (found,) = error.value.diagnostics
    assert found.place.file == "p.zip"
    return found.code


def test_files_are_read_and_a_folder_round_them_left_out():
    assert read_zip(
        zipped([("p/project.json", b"{}"), ("p/trees/A.json", b"a"), ("p/__pycache__/x", b"")])
    ) == {
        "project.json": b"{}",
        "trees/A.json": b"a",
    }
    assert read_zip(zipped([("actions/A.py", b"")])) == {"actions/A.py": b""}


@pytest.mark.parametrize(
    "name", ["../up", "a/../../up", "/etc/passwd", "C:\\x", "a\\b", "c:/x", "line\nbreak", "x" * 1100]
)
def test_paths_that_lead_elsewhere_are_refused(name):
    assert safe_path(name) is None
    assert refused(zipped([(name, b"")])) == "BT0921"


@pytest.mark.parametrize("kind", [stat.S_IFLNK, stat.S_IFIFO, stat.S_IFBLK])
def test_links_and_devices_are_refused(kind):
    entry = zipfile.ZipInfo("link")
    entry.create_system = 3
    entry.external_attr = (kind | 0o777) << 16
    assert refused(zipped([(entry, b"/etc/passwd")])) == "BT0921"


def test_an_entry_that_is_there_twice_is_refused():
    with pytest.warns(UserWarning, match="Duplicate name"):
        raw = zipped([("a", b"1"), ("a", b"2")])
    assert refused(raw) == "BT0921"


def test_bombs_are_refused_before_they_unpack(monkeypatch):
    monkeypatch.setattr(archive, "ARCHIVED_FILE_BYTES", 5_000_000)
    raw = zipped([("bomb", bytes(20_000_000))])
    assert len(raw) < 50_000
    assert refused(raw) == "BT0922"


def test_a_bomb_that_lies_about_its_size_is_refused(monkeypatch):
    monkeypatch.setattr(archive, "ARCHIVED_FILE_BYTES", 5_000_000)
    raw = bytearray(zipped([("bomb", bytes(20_000_000))]))
    size = (20_000_000).to_bytes(4, "little")
    while (at := raw.find(size)) >= 0:
        raw[at : at + 4] = (10).to_bytes(4, "little")
    assert refused(bytes(raw)) in {"BT0920", "BT0922"}


def test_many_small_bombs_are_refused(monkeypatch):
    monkeypatch.setattr(archive, "PROJECT_BYTES", 5_000_000)
    assert refused(zipped([(f"f{number}", bytes(1_000_000)) for number in range(10)])) == "BT0922"
    monkeypatch.setattr(archive, "FILES_PER_PROJECT", 5)
    assert refused(zipped([(f"f{number}", b"") for number in range(10)])) == "BT0922"


@pytest.mark.parametrize(
    "raw", [b"", b"junk", zipped([("a", b"x" * 1000)])[:60]], ids=["empty", "junk", "half"]
)
def test_what_is_no_zip_is_refused(raw):
    assert refused(raw) == "BT0920"


TOOLS = [
    ".git/config",
    ".GIT/hooks/pre-commit",
    "assets/.git/config",
    ".vscode/tasks.json",
    "lib/.idea/workspace.xml",
    ".git",
    "lib/.Git",
    "GIT~1/config",
    ".g\u200cit/config",
    ".\uff27it/config",
    ".github/workflows/ci.yml",
    "\u200c.git/config",
]
OWN = ["trees/A.json", ".gitignore", "assets/.gitkeep", "git/config", "a.git/x", "lib/x.py", ".clang-format"]


def test_what_is_of_a_tool_is_known_by_its_path():
    assert [path for path in TOOLS + OWN if is_of_tool(path)] == TOOLS


def test_what_is_of_a_tool_is_read_from_no_zip_and_goes_into_no_package():
    example = ROOT / "examples" / "laser_bump_and_go"
    files = read_folder(example)
    dirty = files | dict.fromkeys(TOOLS, b"x")
    assert read_zip(zipped(dirty.items())) == files
    package = dict(to_ros2_package(load(dirty)).files)
    # Its own workflow is generated.
    assert package == dict(to_ros2_package(load(files)).files)
    app = read_zip(to_app_zip(load(dirty)))
    assert app
    assert not [path for path in app if is_of_tool(path)]
    assert b"x" not in {*package.values(), *app.values()}


def test_folders_are_read_without_links_and_hidden_folders(tmp_path):
    (tmp_path / "trees").mkdir()
    (tmp_path / "trees" / "A.json").write_text("{}")
    (tmp_path / ".git").mkdir()
    (tmp_path / ".git" / "config").write_text("x")
    (tmp_path / "link").symlink_to("/etc/hostname")
    assert read_folder(tmp_path) == {"trees/A.json": b"{}"}
