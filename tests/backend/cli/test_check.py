"""`bt-studio check`."""

from __future__ import annotations

import json

import pytest

from backend.cli.behaviour_tests import run_tests
from backend.cli.check import check
from backend.cli.shared.errors import CliError
from tests.executor.evaluation.projects import write
from tests.executor.robots.importing.carts import BODY, PAIR, robot

SOUND = '<root BTCPP_format="4"><BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree></root>'


def test_a_sound_tree_has_no_errors(tmp_path, capsys):
    (tmp_path / "t.xml").write_text(SOUND)
    check(str(tmp_path / "t.xml"))
    assert capsys.readouterr().out.endswith("no errors\n")
    check(str(tmp_path / "t.xml"), as_json=True)
    assert json.loads(capsys.readouterr().out)["diagnostics"] == []


def test_a_wrong_one_ends_with_its_findings(tmp_path):
    (tmp_path / "t.xml").write_text(SOUND.replace("AlwaysSuccess", "Sequence"))
    with pytest.raises(CliError, match="BT0104"):
        check(str(tmp_path / "t.xml"))


def test_evaluations_are_checked_with_their_lines(tmp_path, capsys):
    sound = "duration_s: 1\nruns: 2\njudge: {success: [{reach: {area: ahead}}]}\n"
    check(str(write(tmp_path / "sound", sound)))
    assert "no errors" in capsys.readouterr().out
    wrong = write(tmp_path / "wrong", sound.replace("ahead", "nowhere"))
    with pytest.raises(CliError) as found:
        check(str(wrong))
    assert "evaluations/main.yaml:5:" in str(found.value)
    assert "no area 'nowhere'" in str(found.value)


TESTS = """format: bt-studio/test
version: 1
tests:
  - {name: a, ticks: 2, expect: [{at: 1, root: RUNNING}], doubles: {go: RUNNING}}
"""


def test_behaviour_tests_are_checked_as_a_run_of_them_reads_them(tmp_path, capsys):
    folder = write(tmp_path, "duration_s: 1\nruns: 2\njudge: {success: [{never: collision}]}\n")
    (folder / "tests").mkdir()
    file = folder / "tests" / "main.test.yaml"
    file.write_text(TESTS)
    check(str(folder))
    run_tests(str(folder))
    for wrong, place, said in (
        (TESTS.replace("ticks: 2", 'ticks: "2"'), ":4:15:", "write 2"),
        (TESTS.replace("{go:", "{gone:"), ":4:", "'gone'"),
        ("tests: [", ":2:1:", "TG900"),
    ):
        file.write_text(wrong)
        with pytest.raises(CliError) as found:
            check(str(folder))
        assert f"tests/main.test.yaml{place}" in str(found.value)
        assert said in str(found.value)
        with pytest.raises(CliError) as refused:
            run_tests(str(folder))
        assert str(refused.value) == str(found.value)
        capsys.readouterr()
    with pytest.raises(CliError):
        check(str(folder), as_json=True)
    assert json.loads(capsys.readouterr().out)["tests"][0]["file"] == "tests/main.test.yaml"


def test_the_form_of_an_evaluation_is_checked_also_in_a_project_with_errors(tmp_path):
    text = "duration_s: 1\nruns: '2'\njudge: {success: [{never: collision}]}\n"
    folder = write(tmp_path, text, action="class Drive(", universes__other_yaml="things: 3\n")
    with pytest.raises(CliError) as found:
        check(str(folder))
    assert "BT0601" in str(found.value)
    assert "evaluations/main.yaml:4:7: BTU003 runs: must be a whole number; write 2" in str(found.value)


OLD = """format: bt-studio/universe
version: 1
name: An old one
ground: {friction: "0.9"}
models:
  - {id: a, shape: box, size: [1, 1, 1], pose: [0, 0, 0, 0, 0, 0], solid: no}
robots: [{id: r, model: waffle, pose: [2, 0, 0, 0, 0, 0]}]
"""


def test_robots_universes_and_launch_files_are_checked(tmp_path, capsys):
    folder = write(tmp_path / "project", "duration_s: 1\nruns: 2\njudge: {success: [{never: collision}]}\n")
    for name, text in {
        "launch/a_launch.xml": "<launch><node pkg='no_such' exec='x'/></launch>",
        "launch/b.launch.yaml": "launch: 3",
        "universes/other.yaml": "things: 3\n",
        "universes/old.yaml": OLD,
    }.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text)
    with pytest.raises(CliError) as found:
        check(str(folder))
    assert "universes/other.yaml:1:9: BTU003 things is not known" in str(found.value)
    assert "universes/old.yaml:4:20: BTU003 ground.friction: must be a number; write 0.9" in str(found.value)
    assert "universes/old.yaml:6:" in str(found.value)
    assert "solid: must be true or false; write false" in str(found.value)
    assert "launch/b.launch.yaml:1:1: BTL001 a launch file is" in str(found.value)
    (folder / "launch" / "b.launch.yaml").unlink()
    (folder / "universes" / "other.yaml").unlink()
    (folder / "universes" / "old.yaml").unlink()
    check(str(folder))
    said = capsys.readouterr()
    assert said.out.endswith("no errors, 1 warnings\n")
    assert "launch/a_launch.xml:1:1: x cannot be started" in said.err


def test_an_address_that_ros_refuses_is_an_error(tmp_path):
    folder = write(tmp_path / "project", "duration_s: 1\nruns: 2\njudge: {success: [{never: collision}]}\n")
    settings = json.loads((folder / "project.json").read_text())
    settings["maintainer"] = {"name": "Ada", "email": "ada@localhost"}
    (folder / "project.json").write_text(json.dumps(settings))
    with pytest.raises(CliError, match="BT0901"):
        check(str(folder))


ACTION = """import py_trees
import no_such_package
from helper import twice


class Go(py_trees.behaviour.Behaviour):
    def update(self):
        return tools
"""


def test_an_action_is_checked_with_its_neighbours(tmp_path, capsys):
    folder = tmp_path / "actions"
    folder.mkdir()
    (folder / "Go.py").write_text(ACTION)
    (folder / "helper.py").write_text("def twice(): ...\n")
    with pytest.raises(CliError) as found:
        check(str(folder / "Go.py"))
    assert "Go.py:2:1: BT0642" in str(found.value)
    assert "helper" not in str(found.value)
    assert "Go.py:8:16: BT0640" in capsys.readouterr().err
    (tmp_path / "project.json").write_text("{}")
    (tmp_path / "no_such_package").mkdir()
    (tmp_path / "no_such_package" / "a.py").write_text("")
    check(str(folder / "Go.py"))


def test_robots_are_checked_with_their_lines(tmp_path, capsys):
    sound = "duration_s: 1\nruns: 2\njudge: {success: [{reach: {area: ahead}}]}\n"
    project = write(tmp_path / "own", sound)
    folder = project / "robots" / "cart"
    folder.mkdir(parents=True)
    drive = "{left: [left_joint], right: [right_joint], wheel_radius: 0.04, track: 0.2, "
    drive += "max_linear: 1, max_angular: 1}"
    text = f"format: bt-studio/robot\nversion: 1\nname: Cart\nurdf: cart.urdf\ndrive: {drive}\n"
    (folder / "robot.yaml").write_text(text)
    seen = '<link name="flag"><visual><geometry><mesh filename="no.stl"/></geometry></visual></link>'
    flag = (
        f'{seen}\n<joint name="f" type="revolute"><parent link="base_link"/><child link="flag"/>{{}}</joint>'
    )
    limit = '<limit lower="0" upper="1" effort="1" velocity="1"/>'
    (folder / "cart.urdf").write_text(robot(BODY, PAIR, flag.format(limit)))
    check(str(project))
    said = capsys.readouterr()
    assert "no errors, 1 warnings" in said.out
    assert "robots/cart/cart.urdf:13:1: BTR004 there is no file no.stl" in said.err
    (folder / "cart.urdf").write_text(robot(BODY, PAIR, flag.format("")))
    with pytest.raises(
        CliError, match=r"robots/cart/cart\.urdf:14:1: BTR002 the joint 'f' is revolute, so it needs"
    ):
        check(str(project))
    with pytest.raises(CliError):
        check(str(project), as_json=True)
    assert "the joint 'f'" in json.loads(capsys.readouterr().out)["robots"][0]
