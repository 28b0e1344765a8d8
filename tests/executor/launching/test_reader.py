"""Launch files: the nodes that they request, and their errors."""

from __future__ import annotations

import sys

import pytest

from executor.launching.reader import MOST_NODES, read_launch_files
from executor.universes.document import DocumentError

CHECKED = ("-P", "-m", "tree_gardener.ros_script")
"""The fields of messages are checked in a program of the project."""

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
        - {name: limits, value: [1.0, 2.5]}
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
  - timer: {period: 3}
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
        sys.executable, *CHECKED, f"{root}/launch/talker.py", "--loud", "two words", "--ros-args",
        "-r", "__node:=talker", "-r", "__ns:=/turtle", "-r", "chatter:=/say",
        "-p", "speed:=0.4", "-p", "limits:=[1.0, 2.5]", "-p", "deep.gain:=true",
        "--params-file", f"{root}/launch/params.yaml",
    )  # fmt: skip
    assert talker.environment == (("GREETING", "hello"),)
    assert (talker.id, talker.name, talker.line) == ("launch/extra.launch.yaml:6", "talker", 6)
    assert second.command == (sys.executable, *CHECKED, f"{root}/launch/talker.py")
    assert executable.command == (sys.executable, f"{root}/launch/talker.py", "x")
    assert (missing.command, "'turtlesim'" in missing.refusal) == ((), True)
    assert [note.split(": ", 1)[1] for note in plan.notes] == [
        "`output` is left out",
        "`timer` is left out",
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
        ("launch:\n  - node: {exec: $(eval 1)}", (2, 18), "is not read here"),
        ("launch:\n  - include: {file: none.yaml}", (2, 21), "there is no file 'none.yaml'"),
        ("launch:\n  - include: {file: extra.launch.yaml}", (2, 21), "includes itself"),
        ("launch:\n  - group: {scoped: no}", (2, 12), "has a list of actions"),
        ("launch:\n  - node: {exec: x, if: maybe}", (2, 25), "neither true nor false"),
        ('launch:\n  - node: {exec: x, args: "\'"}', (2, 27), "cannot be split"),
        ("launch:\n  - node: {exec: x, param: [{name: a}]}", (2, 29), "has no value"),
        ("launch:\n  - node: {exec: x, param: [{from: ../../etc/passwd}]}", (2, 36), "there is no file"),
        ("launch:\n  - node: {exec: x, param: [{name: a, value: [1, b]}]}", (2, 46), "several types"),
        ("launch:\n  - node: {exec: x, param: [{name: a, value: {b: 1}}]}", (2, 46), "put it in quotes"),
        ("launch:\n  - node: {exec: x, param: [{name: a, value: 1, type: str}]}", (2, 46), "type str"),
        ("launch:\n  - node: {exec: x, param: [{name: a, from: b}]}", (2, 29), "is either"),
        ("launch:\n  - node: {exec: x, param: [{from: b, allow_substs: true}]}", (2, 53), "not read here"),
        ("launch:\n  - node: {exec: x, remap: [{from: a, to: b, too: c}]}", (2, 51), "no 'too' here"),
        ("launch:\n  - node: {exec: x, if: '1', unless: '0'}", (2, 38), "either `if` or"),
        ("launch:\n  - let: {name: a, value: b, values: c}", (2, 38), "no 'values' here"),
        (
            "launch:\n  - arg: {name: a, default: c, choice: [{value: b}, {value: d}]}",
            (2, 10),
            "is 'c', which is not a choice",
        ),
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


def test_what_a_substitution_gives_is_one_word(project):
    [node] = project(
        "launch:\n- arg: {name: a, default: x y}\n"
        "- node: {exec: talker.py, args: 'q --a=$(var a) $(var a)/z \"b c\" \\$(var a)'}\n"
    ).nodes
    assert node.command[-6:] == ("q", "--a=x y", "x y/z", "b c", "$(var", "a)")


def test_let_and_arg_have_conditions(project):
    [node] = project(
        "launch:\n- let: {name: a, value: first}\n- let: {name: a, value: second, if: 'false'}\n"
        "- arg: {name: b, default: third, unless: 'true'}\n"
        "- node: {exec: talker.py, args: $(var a) $(var b fourth)}\n"
    ).nodes
    assert node.command[-2:] == ("first", "fourth")


def test_a_value_that_ros2_launch_refuses_is_reported(project):
    found = project("launch:\n- node: {exec: talker.py, if: true}\n- group: {scoped: false, children: []}\n")
    assert len(found.nodes) == 1
    [note] = found.notes
    assert note.endswith('2:31: `if` is no text, which `ros2 launch` refuses: write "true"')


def test_types_of_parameters_are_those_of_launch(project):
    [node] = project(
        """<launch>
  <node exec="talker.py">
    <param name="a" value="5"/>
    <param name="b" value="5" type="str"/>
    <param name="c" value="a, b" value-sep=","/>
  </node>
</launch>""",
        "a.launch.xml",
    ).nodes
    assert node.command[-5::2] == ("a:=5", "b:='5'", "c:=['a', 'b']")


def test_a_path_out_of_the_project_is_no_file_of_it(project):
    [node] = project("launch: [{node: {exec: ../../../../bin/sh}}]").nodes
    assert node.command == ()
    assert "no file" in node.refusal


@pytest.mark.parametrize("name", ["extra.launch.xml", "extra_launch.xml", "launch.xml", "sub/a_launch.xml"])
def test_xml_means_what_yaml_means(project, name):
    (project.root / "launch" / "sub").mkdir()
    found = project(
        """<launch>
  <arg name="speed" default="0.4"/>
  <let name="robot" value="turtle"/>
  <!-- a comment -->
  <node exec="launch/talker.py" name="talker" namespace="$(var robot)" args="--loud 'two words'">
    <param name="speed" value="$(var speed)"/>
    <param name="deep"><param name="gain" value="true"/></param>
    <param from="launch/params.yaml"/>
    <remap from="chatter" to="/say"/>
    <env name="GREETING" value="hello"/>
  </node>
  <group if="false"><node exec="talker.py"/></group>
  <executable cmd="python3 launch/talker.py x"/>
  <timer period="3"/>
</launch>""",
        name,
    )
    talker, executable = found.nodes
    root = project.root
    assert talker.command == (
        sys.executable, *CHECKED, f"{root}/launch/talker.py", "--loud", "two words", "--ros-args",
        "-r", "__node:=talker", "-r", "__ns:=/turtle", "-r", "chatter:=/say",
        "-p", "speed:=0.4", "-p", "deep.gain:=true", "--params-file", f"{root}/launch/params.yaml",
    )  # fmt: skip
    assert talker.environment == (("GREETING", "hello"),)
    assert (talker.file, talker.line, executable.line) == (f"launch/{name}", 5, 13)
    assert found.notes == (f"launch/{name}:14:1: `timer` is left out",)


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("<launch>\n<node></launch>", 2, "mismatch"),
        ("<robot/>", 1, "begins with <launch>"),
        ("<!DOCTYPE launch [<!ENTITY a 'b'>]>\n<launch>&a;</launch>", 1, "no document type"),
        ("<launch>\n<nod/></launch>", 2, "there is no action 'nod'"),
        ("<launch>\n<node exec='a' parm='b'/></launch>", 2, "there is no 'parm' here"),
        ("<launch>" + "<group>" * 80 + "</group>" * 80 + "</launch>", 1, "nested deeper"),
    ],
)
def test_errors_in_xml_have_their_line(project, text, line, message):
    with pytest.raises(DocumentError, match=message) as caught:
        project(text, "a.launch.xml")
    assert (caught.value.file, caught.value.problems[0].line) == ("launch/a.launch.xml", line)


def test_namespaces_hold_to_the_end_of_their_group(project):
    found = project(
        """
launch:
  - push_ros_namespace: {namespace: fleet}
  - group:
      - push-ros-namespace: {namespace: leo}
      - node: {exec: talker.py, name: a}
      - node: {exec: talker.py, name: b, namespace: arm}
      - node: {exec: talker.py, name: c, namespace: /alone}
  - group:
      scoped: false
      children:
        - push_ros_namespace: {namespace: ada}
  - node: {exec: talker.py, name: d}
  - group: [{push_ros_namespace: {namespace: /root}}, {node: {exec: talker.py, name: e}}]
"""
    )
    names = [next(word for word in node.command if word.startswith("__ns")) for node in found.nodes]
    spaces = ["/fleet/leo", "/fleet/leo/arm", "/alone", "/fleet/ada", "/root"]
    assert names == [f"__ns:={space}" for space in spaces]


def test_a_group_that_forwards_nothing_knows_no_arguments(project):
    with pytest.raises(DocumentError, match="no argument 'a'"):
        project(
            "launch:\n- let: {name: a, value: b}\n"
            "- group: {forwarding: false, children: [{node: {exec: talker.py, name: $(var a)}}]}\n"
        )


def test_an_included_file_is_read_in_its_place_and_not_once_more(project):
    launch = project.root / "launch"
    (launch / "robot_launch.yaml").write_text(
        "launch:\n- arg: {name: robot, default: none}\n- let: {name: seen, value: yes}\n"
        "- node: {exec: $(dirname)/talker.py, name: $(var robot)}\n"
    )
    found = project(
        """<launch>
  <push_ros_namespace namespace="fleet"/>
  <include file="$(dirname)/robot_launch.yaml"><arg name="robot" value="leo"/></include>
  <include file="robot_launch.yaml" unless="true"/>
  <node exec="talker.py" name="$(var seen)"/>
</launch>""",
        "main.launch.xml",
    )
    assert [(node.name, node.file, node.line) for node in found.nodes] == [
        ("leo", "launch/robot_launch.yaml", 4),
        ("true", "launch/main.launch.xml", 5),
    ]
    assert "__ns:=/fleet" in found.nodes[0].command


def test_an_included_file_in_python_or_of_a_package_that_is_missing_is_listed_with_its_line(project):
    (project.root / "launch" / "old_launch.py").write_text("")
    found = project(
        "launch:\n- include: {file: old_launch.py, arg: [{name: a, value: b}]}\n"
        "- include: {file: $(find-pkg-share no_such)/a.launch.py}\n"
    )
    old, other = found.nodes
    assert (old.id, "`launch` of ROS 2" in old.refusal) == ("launch/extra.launch.yaml:2", True)
    assert (other.id, "no package 'no_such'" in other.refusal) == ("launch/extra.launch.yaml:3", True)


def test_nodes_of_one_line_have_ids_of_their_own(project):
    found = project("<launch><node exec='talker.py'/><node exec='talker.py'/></launch>", "a.launch.xml")
    assert [node.id for node in found.nodes] == ["launch/a.launch.xml:1", "launch/a.launch.xml:1 (2)"]


def test_files_that_include_each_other_are_refused_with_the_line(project):
    (project.root / "launch" / "a_launch.yaml").write_text("launch: [{include: {file: b_launch.yaml}}]")
    with pytest.raises(DocumentError, match="includes itself"):
        project("launch:\n- include: {file: a_launch.yaml}\n", "b_launch.yaml")


def test_includes_within_each_other_are_bounded(project):
    for number in range(40):
        text = f"launch: [{{include: {{file: x{number + 1}_launch.yaml}}}}]"
        (project.root / "launch" / f"x{number}_launch.yaml").write_text(text)
    with pytest.raises(DocumentError, match="more than 32 includes"):
        project("launch: []", "x40_launch.yaml")
