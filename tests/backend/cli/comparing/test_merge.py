"""`bt-studio merge`."""

from __future__ import annotations

import json

import pytest

from backend.cli.comparing.merge import merge
from backend.cli.shared.errors import CliError
from tests.shared.make_differences import OLDER, changed


@pytest.fixture
def write(tmp_path):
    def work(name, content):
        path = tmp_path / name
        path.write_text(content if isinstance(content, str) else json.dumps(content))
        return path

    return work


def test_the_result_is_written_or_printed(write, tmp_path, capfdbinary):
    sides = write("b", OLDER), write("o", changed(a={"name": "x"})), write("t", changed(c={"name": "y"}))
    merge(*sides, output=tmp_path / "out.json")
    document = json.loads((tmp_path / "out.json").read_text())
    assert (document["nodes"]["a"]["name"], document["nodes"]["c"]["name"]) == ("x", "y")
    merge(*sides)
    assert json.loads(capfdbinary.readouterr().out) == document


def test_conflicts_end_with_1_and_are_in_the_file(write, tmp_path):
    sides = write("b", OLDER), write("o", changed(c={"name": "x"})), write("t", changed(c={"name": "y"}))
    with pytest.raises(CliError, match="conflict in MainTree: name \\[c\\]: ours “x”, theirs “y”") as error:
        merge(*sides, output=tmp_path / "out.json", name="trees/MainTree.json")
    assert error.value.status == 1
    assert str(error.value).startswith("trees/MainTree.json: ")
    assert json.loads((tmp_path / "out.json").read_text())["conflicts"][0]["node"] == "c"


def test_files_that_are_no_trees(write, tmp_path):
    sides = write("b", "{"), write("o", "{1"), write("t", "{2")
    with pytest.raises(CliError, match="BT0001"):
        merge(*sides)
    xml = '<root BTCPP_format="4"><BehaviorTree ID="T"><A/></BehaviorTree>{}</root>'
    sides = write("b", xml.format("")), write("o", xml.format("<!--o-->")), write("t", xml.format("<!--t-->"))
    with pytest.raises(CliError, match="merge them by lines"):
        merge(*sides)


def test_for_git_they_are_merged_by_lines(write):
    base, ours = write("b", "1\n2\n3\n4\n5\n"), write("o", "one\n2\n3\n4\n5\n")
    with pytest.raises(SystemExit) as done:
        merge(base, ours, write("t", "1\n2\n3\n4\nfive\n"), output=ours, as_git=True)
    assert done.value.code == 0
    assert ours.read_text() == "one\n2\n3\n4\nfive\n"
    with pytest.raises(SystemExit) as done:
        merge(base, ours, write("t", "uno\n2\n3\n4\n5\n"), output=ours, as_git=True, name="a/b.xml")
    assert done.value.code == 1
    assert "<<<<<<< a/b.xml (ours)" in ours.read_text()
