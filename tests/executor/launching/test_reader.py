"""Launch files: the nodes that they request, and their errors."""

from __future__ import annotations

import sys

import pytest

from executor.launching.reader import MOST_NODES, read_launch_files
from executor.universes.document import DocumentError

FULL = """
launch:
  - arg: {name: speed, default: "0.4"}
  - let: {name: robot, value: turtle}
  - node:
      exec: launch/talker.py
      name: talker
      namespace: $(var robot)
      args: --loud "two words"
      param:
        - {name: speed, value: $(var speed)}
        - {name: limits, value: [1, 2.5]}
        - {name: deep, param: [{name: gain, value: true}]}
        - {from: launch/params.yaml}
      remap:
        - {from: chatter, to: /say}
      env:
        - {name: GREETING, value: hello}
  - group:
      - let: {name: robot, value: other}
      - node: {exec: talker.py, if: "false"}
      - node: {exec: talker.py, unless: "$(var off)"}
  - executable: {cmd: python3 $(dirname)/talker.py x}
  - node: {pkg: turtlesim, exec: turtlesim_node, output: screen}
  - include: {file: other.launch.yaml}
"""


@pytest.fixture
def project(tmp_path):
    (tmp_path / "launch").mkdir()
    (tmp_path / "launch" / "talker.py").write_text("print('hello')\n")
    (tmp_path / "launch" / "params.yaml").write_text("{}\n")

    def write(text, name="extra.launch.yaml"):
        (tmp_path / "launch" / name).write_text(text)
        return read_launch_files(tmp_path)

    write.root = tmp_path  # type: ignore[attr-defined]
    return write


def test_a_project_without_launch_files_has_no_launch_nodes(tmp_path):
    assert read_launch_files(tmp_path).nodes == ()


def test_a_node_is_read_with_all_that_it_is_given(project):
    plan = project(FULL.replace("$(var off)", "false"))
    talker, second, executable, missing = plan.nodes
    root = project.root
    assert talker.command == (
        sys.executable, f"{root}/launch/talker.py", "--loud", "two words", "--ros-args",
        "-r", "__node:=talker", "-r", "__ns:=/turtle", "-r", "chatter:=/say",
        "-p", "speed:=0.4", "-p", "limits:=[1, 2.5]", "-p", "deep.gain:=true",
        "--params-file", f"{root}/launch/params.yaml",
    )  # fmt: skip
    assert talker.environment == (("GREETING", "hello"),)
    assert (talker.id, talker.name, talker.line) == ("launch/extra.launch.yaml:6", "talker", 6)
    assert second.command == (sys.executable, f"{root}/launch/talker.py")
    assert executable.command == (sys.executable, f"{root}/launch/talker.py", "x")
    assert (missing.command, "'turtlesim'" in missing.refusal) == ((), True)
    assert [note.split(": ", 1)[1] for note in plan.notes] == [
        "`output` is left out",
        "`include` is left out",
    ]


def test_a_package_is_found_where_a_workspace_is_sourced(project, tmp_path, monkeypatch):
    program = tmp_path / "ws" / "lib" / "my_robot" / "driver"
    program.parent.mkdir(parents=True)
    program.write_text("#!/bin/sh\n")
    program.chmod(0o755)
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path / "ws"))
    [node] = project("launch: [{node: {pkg: my_robot, exec: driver}}]").nodes
    assert node.command == (str(program),)
    [node] = project("launch: [{node: {pkg: my_robot, exec: ghost}}]").nodes
    assert "cannot be found" in node.refusal


def test_a_python_launch_file_is_listed_with_the_reason_why_it_is_not_started(project):
    [node] = project("", "old.launch.py").nodes
    assert (node.id, "`launch` of ROS 2" in node.refusal) == ("launch/old.launch.py", True)


@pytest.mark.parametrize(
    ("text", "place", "message"),
    [
        ("nodes: []", (1, 1), "a launch file is"),
        ("launch:\n  - node: {exec: x", (3, 1), "expected"),
        ("launch:\n  - nod: {exec: x}", (2, 10), "there is no action 'nod'"),
        ("launch:\n  - node: {exec: x, parm: []}", (2, 27), "there is no 'parm' here"),
        ("launch:\n  - node: {pkg: x}", (2, 11), "`exec` is missing"),
        ("launch:\n  - node: {exec: [x]}", (2, 18), "`exec` must be a text"),
        ("launch:\n  - node: {exec: $(var x)}", (2, 18), "no argument 'x'"),
        ("launch:\n  - node: {exec: $(env HOME)}", (2, 18), "is not read here"),
        ("launch:\n  - node: {exec: x, if: maybe}", (2, 25), "neither true nor false"),
        ('launch:\n  - node: {exec: x, args: "\'"}', (2, 27), "cannot be split"),
        ("launch:\n  - node: {exec: x, param: [{name: a}]}", (2, 29), "has no value"),
        ("launch:\n  - node: {exec: x, param: [{from: ../../etc/passwd}]}", (2, 36), "there is no file"),
        ("launch:\n  - node: {exec: x, env: {A: b}}", (2, 26), "is a list"),
        ("launch: [&a {node: {exec: x}}, *a]", None, ""),
        ("launch: !!python/object/apply:os.system [ls]", (1, 9), "tag"),
        ("launch:\n" + "  - node: {exec: x}\n" * (MOST_NODES + 1), (MOST_NODES + 2, 11), "more than"),
    ],
)
def test_errors_are_refused_with_their_place(project, text, place, message):
    if place is None:
        assert len(project(text).nodes) == 2
        return
    with pytest.raises(DocumentError) as caught:
        project(text)
    problem = caught.value.problems[0]
    assert caught.value.file == "launch/extra.launch.yaml"
    assert ((problem.line, problem.column), message in problem.message) == (place, True)


def test_a_path_out_of_the_project_is_no_file_of_it(project):
    [node] = project("launch: [{node: {exec: ../../../../bin/sh}}]").nodes
    assert node.command == ()
    assert "no file" in node.refusal
