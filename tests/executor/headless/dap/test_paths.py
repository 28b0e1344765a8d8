"""Paths of a client on this machine, and on another one."""

from __future__ import annotations

from pathlib import Path, PurePath, PurePosixPath, PureWindowsPath

import pytest

from executor.headless.dap.paths import Folder, local_root

HERE = Path("/home/robot/project")
LAPTOP = PurePosixPath("/Users/ann/project")
WINDOWS = PureWindowsPath("C:\\Users\\ann\\project")


@pytest.mark.parametrize(
    ("local", "path"),
    [
        (None, "/home/robot/project/trees/main.json"),
        (None, "/home/robot/other/../project/trees/main.json"),
        (LAPTOP, "/Users/ann/project/trees/main.json"),
        (WINDOWS, "c:\\users\\ann\\project\\trees\\main.json"),
    ],
)
def test_a_file_below_the_folder_is_found_and_named_as_the_client_does(
    local: PurePath | None, path: str
) -> None:
    folder = Folder(HERE, local)
    assert folder.below(path) == "trees/main.json"
    name, named = folder.named("trees/main.json")
    assert name == "main.json"
    assert folder.below(named) == "trees/main.json"
    assert folder.hint(path) == ""
    assert type(local or HERE)(named).is_relative_to(local or HERE)


def test_a_file_that_only_another_machine_can_have_asks_for_its_folder(tmp_path: Path) -> None:
    (tmp_path / "other.json").touch()
    assert '"localRoot" of launch' in Folder(HERE).hint("/Users/ann/project/trees/main.json")
    assert Folder(HERE).hint(str(tmp_path / "other.json")) == ""
    remote = Folder(HERE, LAPTOP)
    assert remote.below("/home/robot/project/trees/main.json") == "/home/robot/project/trees/main.json"
    assert remote.hint("/home/robot/project/trees/main.json") == ""


@pytest.mark.parametrize(
    ("text", "root"),
    [
        ("/Users/ann/project", LAPTOP),
        ("C:\\Users\\ann\\project", WINDOWS),
        ("C:/Users/ann/project", WINDOWS),
        ("\\\\server\\share\\p", PureWindowsPath("//server/share/p")),
        ("project", None),
        ("", None),
        ("C:project", None),
        ("${workspaceFolder}", None),
    ],
)
def test_the_folder_of_another_machine_is_an_absolute_path(text: str, root: PurePath | None) -> None:
    assert local_root(text) == root
