"""`bt-studio git` in real repositories: merge, rebase, cherry-pick, stash."""

from __future__ import annotations

import json
import os
import subprocess

import pytest
import typer

from backend.cli.comparing.git import changes, install, uninstall
from backend.cli.shared.errors import CliError
from tests.shared.make_differences import OLDER, changed
from translator.diagram import document_text
from translator.merge.files import read_diagram

TREE = "trees/MainTree.json"
XML = """<root BTCPP_format="4">
  <BehaviorTree ID="T">
    <Sequence>
      <A x="1"/>
      <B/>
    </Sequence>
  </BehaviorTree>
</root>
"""
OURS = changed(c={"name": "x"}, r={"children": ["w", "b", "c", "s"]}, w={"type": "Repeat", "children": ["a"]})
THEIRS = changed(a={"ports": {"speed": "0.9", "gone": "x"}}, r={"children": ["s", "a", "b", "c"]})
RIVAL = changed(c={"name": "y"})


class Git:
    """A repository with the driver installed, and three branches."""

    def __init__(self, top):
        self.top = top
        self.environment = {
            **os.environ, "GIT_CONFIG_GLOBAL": "/dev/null", "GIT_CONFIG_SYSTEM": "/dev/null",
            "GIT_EDITOR": "true",
            **{f"GIT_{who}_{what}": "a@b.c" for who in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")},
        }  # fmt: skip

    def __call__(self, *arguments, status=0):
        done = subprocess.run(
            ["git", *arguments],
            cwd=self.top,
            env=self.environment,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == status, done.stdout + done.stderr
        return done.stdout + done.stderr

    def write(self, document, path=TREE):
        (self.top / path).parent.mkdir(exist_ok=True)
        text = document if isinstance(document, str) else document_text(document)
        (self.top / path).write_text(text)

    def branch(self, name, document, path=TREE):
        self("switch", "-q", "-c", name, "main")
        self.write(document, path)
        self("commit", "-qam", name)

    def tree(self):
        return read_diagram((self.top / TREE).read_bytes(), TREE)


@pytest.fixture
def git(tmp_path):
    made = Git(tmp_path)
    made("init", "-q", "-b", "main")
    made.write(OLDER)
    made.write(XML, "bt/tree.xml")
    made("add", ".")
    install(tmp_path, yes=True)
    made("add", ".gitattributes")
    made("commit", "-qm", "base")
    for name, document in (("ours", OURS), ("theirs", THEIRS), ("rival", RIVAL)):
        made.branch(name, document)
    return made


def assert_both(tree):
    assert tree["nodes"]["r"]["children"] == ["s", "w", "b", "c"]
    assert tree["nodes"]["a"]["ports"]["speed"] == "0.9"
    assert tree["nodes"]["c"]["name"] == "x"
    assert "conflicts" not in tree


def test_merge(git):
    git("switch", "-q", "ours")
    git("merge", "-q", "--no-edit", "theirs")
    assert_both(git.tree())


def test_rebase(git):
    git("switch", "-q", "ours")
    git("rebase", "-q", "theirs")
    assert_both(git.tree())


def test_cherry_pick(git):
    git("switch", "-q", "theirs")
    git("cherry-pick", "ours")
    assert_both(git.tree())


def test_stash(git):
    git("switch", "-q", "main")
    git.write(THEIRS)
    git("stash", "-q")
    git("merge", "-q", "ours")
    git("stash", "pop", "-q")
    assert_both(git.tree())


def conflicting(git):
    (conflict,) = git.tree()["conflicts"]
    assert conflict["op"] == "rename"
    assert git("diff", "--name-only", "--diff-filter=U").strip() == TREE
    return conflict["ours"], conflict["theirs"]


def test_a_conflict_is_valid_json_in_each_of_them(git):
    """In a rebase and a stash, ours is what was there already."""
    git("switch", "-q", "ours")
    assert "conflict in MainTree: name [c]" in git("merge", "rival", status=1)
    assert conflicting(git) == ("x", "y")
    git("merge", "--abort")
    git("rebase", "rival", status=1)
    assert conflicting(git) == ("y", "x")
    git("rebase", "--abort")
    git("cherry-pick", "rival", status=1)
    assert conflicting(git) == ("x", "y")
    git("cherry-pick", "--abort")
    git("switch", "-q", "main")
    git.write(RIVAL)
    git("stash", "-q")
    git("merge", "-q", "ours")
    git("stash", "pop", status=1)
    assert conflicting(git) == ("x", "y")


def test_a_conflict_is_solved_by_taking_its_entry_out(git):
    git("switch", "-q", "ours")
    git("merge", "rival", status=1)
    git.write({key: value for key, value in git.tree().items() if key != "conflicts"})
    git("commit", "-qam", "merged")
    assert git("status", "--porcelain") == ""


def test_xml_with_trees_and_without(git):
    for name, text in (("left", XML.replace('"1"', '"2"')), ("right", XML.replace("<B/>", '<B y="3"/>'))):
        git.branch(name, text, "bt/tree.xml")
    git("switch", "-q", "left")
    git("merge", "-q", "--no-edit", "right")
    text = (git.top / "bt/tree.xml").read_text()
    assert text == XML.replace('"1"', '"2"').replace("<B/>", '<B y="3"/>')


def test_git_diff_prints_operations(git):
    git("switch", "-q", "ours")
    assert "+ Repeat [w]: put around Forward [a]" in git("diff", "main")
    git.write({**OURS, "layout": "horizontal"})
    assert "layout or other parts" in git("diff")
    git.write("no JSON")
    assert "+no JSON" in git("diff")


def test_uninstall_gives_git_its_lines_back(git):
    uninstall(git.top, yes=True)
    git("commit", "-qam", "without")
    git("switch", "-q", "ours")
    assert "@@" in git("diff", "main", "--", TREE)


def test_it_is_shown_first_and_nothing_is_written_without_a_yes(tmp_path, monkeypatch, capsys):
    git = Git(tmp_path)
    git("init", "-q")
    before = (tmp_path / ".git/config").read_text()

    def no(*_, **__):
        raise typer.Abort

    monkeypatch.setattr(typer, "confirm", no)
    with pytest.raises(typer.Abort):
        install(tmp_path)
    assert "merge.bt-studio.driver = " in capsys.readouterr().out
    assert (tmp_path / ".git/config").read_text() == before
    assert not (tmp_path / ".gitattributes").exists()


def test_the_driver_of_git_diff_needs_its_arguments():
    with pytest.raises(CliError, match="seven arguments"):
        changes(["a"])


def test_a_new_file(tmp_path, capsys):
    (tmp_path / "t.json").write_text(json.dumps(OLDER))
    changes([TREE, "/dev/null", ".", ".", str(tmp_path / "t.json"), "0", "100644"])
    assert "+ tree MainTree added, 9 nodes" in capsys.readouterr().out
