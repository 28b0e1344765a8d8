"""The entries that `bt-studio git` writes to a repository."""

from __future__ import annotations

import subprocess

import pytest

from backend.cli.comparing.git_repository import BEGIN, END, Repository, merge_lines, settings, show_lines
from backend.cli.shared.errors import CliError


@pytest.fixture
def top(tmp_path):
    subprocess.run(["git", "init", "-q", str(tmp_path)], check=True)
    return tmp_path


def config(top):
    done = subprocess.run(
        ["git", "-C", str(top), "config", "--local", "--list"], check=True, capture_output=True
    )
    return done.stdout.decode()


def test_install_and_uninstall_leave_nothing_else_changed(top):
    (top / ".gitattributes").write_text("*.png binary")
    before = config(top)
    repository = Repository(top)
    repository.install()
    repository.install()
    text = (top / ".gitattributes").read_text()
    assert text == f"*.png binary\n{BEGIN}\n**/trees/*.json diff=bt-studio merge=bt-studio\n{END}\n"
    assert "merge.bt-studio.driver=" in config(top)
    repository.uninstall()
    assert (top / ".gitattributes").read_text() == "*.png binary\n"
    assert config(top) == before
    repository.uninstall()


def test_a_file_that_was_made_goes_again(top):
    repository = Repository(top)
    repository.install()
    repository.uninstall()
    assert not (top / ".gitattributes").exists()


def test_folders_of_tracked_trees_in_xml(top):
    for name, text in {
        "a b/t.xml": "<root><BehaviorTree/></root>", "package.xml": "<package/>",
        "main.xml": "<BehaviorTree", "untracked/t.xml": "<BehaviorTree",
    }.items():  # fmt: skip
        (top / name).parent.mkdir(exist_ok=True)
        (top / name).write_text(text)
    subprocess.run(["git", "-C", str(top), "add", "a b", "package.xml", "main.xml"], check=True)
    assert Repository(top).tree_patterns() == ["**/trees/*.json", "/a?b/*.xml", "/*.xml"]


def test_no_repository(tmp_path, monkeypatch):
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(tmp_path.parent))
    with pytest.raises(CliError, match="no git repository"):
        Repository(tmp_path)


def test_the_driver_is_this_program():
    assert settings()["merge.bt-studio.driver"].endswith("merge %O %A %B -o %A --git --name %P")


def test_lines(tmp_path, capfd):
    one, other, third = (tmp_path / name for name in "abc")
    one.write_text("1\n")
    other.write_text("2\n")
    third.write_text("3\n")
    show_lines(one, other)
    assert "+2" in capfd.readouterr().out
    assert merge_lines(one, other, third, name="n") == 1
