"""`bt-studio import`."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from backend.cli.import_ import import_
from backend.cli.shared.errors import CliError
from translator import check, load
from translator.archive import read_folder
from translator.export import self_contained
from tree_gardener import Tree

TREE = '<root BTCPP_format="4"><BehaviorTree ID="T"><Drive speed="1"/></BehaviorTree></root>'


def test_a_tree_becomes_a_project_with_stubs_of_its_actions(tmp_path, capsys):
    (tmp_path / "t.xml").write_text(TREE)
    import_(str(tmp_path / "t.xml"), tmp_path / "made", as_json=True)
    assert (tmp_path / "made" / "actions" / "Drive.py").is_file()
    assert json.loads(capsys.readouterr().out)


def test_nonsense_makes_nothing(tmp_path):
    (tmp_path / "t.xml").write_text("<root>&</root>")
    with pytest.raises(CliError):
        import_(str(tmp_path / "t.xml"), tmp_path / "made")
    assert not (tmp_path / "made").exists()


@pytest.mark.parametrize(
    "option", [{"actions": Path("actions")}, {"repair": True}, {"order": "top-to-bottom"}]
)
def test_what_a_python_file_has_no_use_for_is_refused(tmp_path, option):
    (tmp_path / "t.py").write_text("import py_trees\n")
    with pytest.raises(CliError) as refused:
        import_(str(tmp_path / "t.py"), tmp_path / "made", **option)
    assert "are not for a Python file" in str(refused.value.lines)
    assert not (tmp_path / "made").exists()


def test_the_main_tree_of_a_folder_can_be_named(tmp_path, capsys):
    folder = tmp_path / "trees"
    folder.mkdir()
    for name in ("One", "Two"):
        (folder / f"{name}.xml").write_text(TREE.replace('"T"', f'"{name}"'))
    with pytest.raises(CliError) as refused:
        import_(str(folder), tmp_path / "made")
    assert "--main 'One'" in str(refused.value.lines)
    import_(str(folder), tmp_path / "made", main="Two", as_json=True)
    assert json.loads(capsys.readouterr().out)["trees"] == ["One", "Two"]
    assert json.loads((tmp_path / "made" / "project.json").read_text())["main_tree"] == "Two"


PY_TREES = """import py_trees


class Go(py_trees.behaviour.Behaviour):
    def update(self):
        return py_trees.common.Status.RUNNING


def create_root():
    return py_trees.decorators.{decorator}
"""


def test_a_file_with_a_tree_of_py_trees_becomes_blocks(tmp_path, capsys):
    (tmp_path / "robot.py").write_text(PY_TREES.format(decorator="Retry('again', Go('go'), 3)"))
    import_(str(tmp_path / "robot.py"), tmp_path / "made", as_json=True)
    assert json.loads(capsys.readouterr().out)["actions"] == ["Go", "Retry"]
    assert (tmp_path / "made" / "actions" / "robot.py").is_file()


def test_a_tree_of_py_trees_that_is_one_block_runs_and_shows_what_is_inside(tmp_path, capsys):
    guard = "EternalGuard('guard', Go('go'), condition=lambda: True)"
    (tmp_path / "robot.py").write_text(PY_TREES.format(decorator=guard))
    import_(str(tmp_path / "robot.py"), tmp_path / "made")
    assert "one block, since the class EternalGuard of 'guard'" in capsys.readouterr().err
    project = load(read_folder(tmp_path / "made"))
    assert [item for item in check(project) if item.is_error] == []
    tree = Tree.from_xml(self_contained(project))
    seen: list = []
    tree.observe(lambda changes: seen.extend(changes.blackboard))
    assert tree.tick_exactly_once().name == "RUNNING"
    assert {each.scope for each in seen} == {"py_trees:Robot::1"}
    assert [(each.key, each.value) for each in seen] == [("guard/go", "RUNNING"), ("guard", "RUNNING")]


def test_what_is_wrong_with_a_file_of_py_trees_is_said(tmp_path):
    (tmp_path / "robot.py").write_text("x = 1\n")
    with pytest.raises(CliError) as refused:
        import_(str(tmp_path / "robot.py"), tmp_path / "made")
    assert "robot.py:1:1: it makes no tree of py_trees" in str(refused.value.lines)
    with pytest.raises(CliError):
        import_(str(tmp_path / "none.py"), tmp_path / "made")
    assert not (tmp_path / "made").exists()


def test_a_tree_of_nav2_says_its_distribution_and_is_imported_for_another_one(tmp_path, capsys):
    nodes = '<Sequence><IsPathValid path="{p}"/><DockRobot dock_type="d"/></Sequence>'
    (tmp_path / "t.xml").write_text(TREE.replace('<Drive speed="1"/>', nodes))
    import_(str(tmp_path / "t.xml"), tmp_path / "found")
    assert "ROS distribution: Jazzy\n" in capsys.readouterr().out
    import_(str(tmp_path / "t.xml"), tmp_path / "made", ros_distro="lyrical")
    assert "ROS distribution: Lyrical\n" in capsys.readouterr().out
    assert (tmp_path / "made" / "actions" / "ValidatePath.py").is_file()
    import_(str(tmp_path / "t.xml"), tmp_path / "old", ros_distro="humble", as_json=True)
    answer = json.loads(capsys.readouterr().out)
    assert (answer["ros_distro"], answer["lacks"]) == ("humble", ["DockRobot"])
    with pytest.raises(CliError) as refused:
        import_(str(tmp_path / "t.xml"), tmp_path / "no", ros_distro="foxy")
    assert "--ros-distro is humble, jazzy, kilted, lyrical." in str(refused.value.lines)
