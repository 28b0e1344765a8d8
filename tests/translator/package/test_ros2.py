"""The ROS 2 package as files: names, dependencies, licence, launch files, the same bytes again."""

from __future__ import annotations

import ast
import io
import os
import re
import subprocess
import sys
import zipfile
from typing import Any

import pytest
import yaml
from catkin_pkg.package import parse_package

from translator import TranslatorError, load, to_ros2_package
from translator.package.naming import package_name, problem_with
from translator.package.ros2 import engine_version
from tree_gardener import __version__

LEAF = {"n1": {"type": "Act"}}


def parsed(package, tmp_path, folder=None):
    """The package.xml as catkin_pkg reads and validates it."""
    path = tmp_path / "package.xml"
    path.write_bytes(package.files[f"{folder or package.name}/package.xml"])
    warnings: list[Any] = []
    found = parse_package(str(path), warnings=warnings)
    found.validate(warnings=warnings)
    assert warnings == []
    return found


def test_examples_are_valid_packages(example, tmp_path):
    package = to_ros2_package(example)
    assert package.diagnostics == ()
    for folder in (package.name, "tree_gardener"):
        found = parsed(package, tmp_path, folder)
        assert found.name == folder
        assert found.get_build_type() == "ament_python"
    names = {item.name for item in parsed(package, tmp_path).exec_depends}
    assert {"rclpy", "py_trees", "tree_gardener", "geometry_msgs", "sensor_msgs", "launch_ros"} <= names
    assert ("python3-opencv" in names) == (package.name == "visual_follow_person")


def test_every_python_and_yaml_file_is_well_formed(example):
    for path, raw in to_ros2_package(example).files.items():
        if path.endswith(".py"):
            ast.parse(raw)
        elif path.endswith(".yaml"):
            assert yaml.safe_load(raw)


def test_same_input_gives_the_same_bytes(example):
    zipped = to_ros2_package(example).to_zip()
    assert zipped == to_ros2_package(load(dict(reversed(example.files.items())))).to_zip()
    with zipfile.ZipFile(io.BytesIO(zipped)) as archive:
        assert archive.namelist() == sorted(archive.namelist())
        assert {entry.date_time for entry in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}


def test_text_of_users_does_not_break_the_files(make_project, tmp_path):
    nasty = "A \"quoted\" 'name' & <tag> \\ {{ x }} {% raw %} é\nnext"
    project = make_project(
        LEAF,
        name=nasty,
        description=nasty,
        license="My & own",
        maintainer={"name": nasty, "email": "me@example.org"},
    )
    package = to_ros2_package(project)
    found = parsed(package, tmp_path)
    assert "&lt;tag&gt;" in found.description
    ast.parse(package.files[f"{package.name}/setup.py"])
    assert b"{% raw %}" in package.files[f"{package.name}/README.md"]


def test_import_without_a_package_is_reported_with_its_line(make_project):
    source = (
        "import json\nimport py_trees\nimport nobody_has_this.part\nfrom actions import Open\nimport Open\n"
        "class Act(py_trees.behaviour.Behaviour):\n    def update(self):\n        import yaml, PIL.Image\n"
    )
    package = to_ros2_package(make_project(LEAF, actions={"Act": source}))
    (found,) = package.diagnostics
    assert (found.code, found.place.file, found.place.line) == ("BT0910", "actions/Act.py", 3)
    text = package.files["test_bt/package.xml"].decode()
    assert "python3-yaml" in text
    assert "python3-pil" in text
    assert "json" not in text


def test_launch_files_assets_and_requirements_travel_along(make_project):
    files = {
        "launch/camera.launch.py": b"camera",
        "launch/test_bt.launch.py": b"own",
        "assets/models/net.onnx": b"net",
        "requirements.txt": b"onnxruntime\n",
        "LICENSE": b"mine",
    }
    package = to_ros2_package(make_project(LEAF, files=files))
    assert package.files["test_bt/launch/camera.launch.py"] == b"camera"
    assert package.files["test_bt/launch/project_test_bt.launch.py"] == b"own"
    assert package.files["test_bt/assets/models/net.onnx"] == b"net"
    assert package.files["test_bt/LICENSE"] == b"mine"
    assert b"project_test_bt.launch.py" in package.files["test_bt/launch/test_bt.launch.py"]
    assert b"share/test_bt/assets/models" in package.files["test_bt/setup.py"]
    assert b"requirements.txt" in package.files["test_bt/README.md"]


LAUNCH = b"""launch:
  - node:
      exec: launch/talker.py  # ours
      name: talker
  - node: {exec: "tools/listener.py"}
  - node:
      pkg: demo_nodes_py
      exec: listener
"""


def test_programs_of_launch_files_become_executables_of_the_package(make_project):
    files = {
        "launch/nodes.launch.yaml": LAUNCH,
        "launch/talker.py": b"import rclpy\nimport cv2\n",
        "launch/tools/listener.py": b"#!/usr/bin/env python3\nimport rclpy\n",
    }
    package = to_ros2_package(make_project(LEAF, files=files))
    text = package.files["test_bt/launch/nodes.launch.yaml"].decode()
    nodes = [action["node"] for action in yaml.safe_load(text)["launch"]]
    assert nodes[0] == {"pkg": "test_bt", "exec": "talker.py", "name": "talker"}
    assert nodes[2] == {"pkg": "demo_nodes_py", "exec": "listener"}
    assert nodes[1] == {"pkg": "test_bt", "exec": "tools_listener.py"}
    assert "# ours" in text
    assert package.diagnostics == ()
    setup = package.files["test_bt/setup.py"].decode()
    assert "scripts=['scripts/talker.py', 'scripts/tools_listener.py']" in setup
    assert package.files["test_bt/scripts/talker.py"].split(b"\n")[1].startswith(b"import rclpy")
    assert package.files["test_bt/scripts/tools_listener.py"].count(b"#!") == 1
    manifest = package.files["test_bt/package.xml"].decode()
    assert "launch_yaml" in manifest
    assert "python3-opencv" in manifest
    assert b"nodes.launch.yaml" in package.files["test_bt/launch/test_bt.launch.py"]


XML_LAUNCH = b"""<launch>
  <node name="a" exec="launch/my &amp; talker.py"/>
  <node pkg="other" exec="launch/talker.py"/>
  <node
    exec = 'talker.py' name="b"/>
</launch>"""


def launched_as(make_project, path, raw, *programs):
    files = {f"launch/{path}": raw, **{f"launch/{name}": b"import rclpy" for name in programs}}
    package = to_ros2_package(make_project(LEAF, files=files))
    return package, package.files[f"test_bt/launch/{path}"].decode()


def test_launch_files_in_xml_name_executables_too(make_project):
    _, text = launched_as(make_project, "n.launch.xml", XML_LAUNCH, "talker.py")
    assert """exec="launch/my &amp; talker.py"/>""" in text
    assert """<node pkg="other" exec="launch/talker.py"/>""" in text
    assert """<node\n    pkg="test_bt" exec="talker.py" name="b"/>""" in text


@pytest.mark.parametrize(
    ("entry", "node"),
    [
        ("exec: launch/talker.py", {"exec": "talker.py"}),
        ("exec: ./launch/talker.py", {"exec": "talker.py"}),
        ("exec: talker.py", {"exec": "talker.py"}),
        ("exec: $(dirname)/talker.py", {"exec": "talker.py"}),
        ("exec: 'launch/it''s mine.py'", {"exec": "it's mine.py"}),
        ('"exec": "launch/it\'s mine.py"', {"exec": "it's mine.py"}),
        ("exec:\n        launch/r\u00f6bot.py", {"exec": "r\u00f6bot.py"}),
        ("name: \u00f6\n      exec: launch/talker.py\n      # more", {"exec": "talker.py", "name": "\u00f6"}),
    ],
)
@pytest.mark.parametrize("ending", ["\n", "\r\n"])
def test_programs_are_known_however_yaml_writes_them(make_project, entry, node, ending):
    raw = f"launch:\n  - node:\n      {entry}\n".replace("\n", ending).encode()
    programs = ("talker.py", "it's mine.py", "r\u00f6bot.py")
    package, text = launched_as(make_project, "n.launch.yaml", raw, *programs)
    assert yaml.safe_load(text)["launch"] == [{"node": {"pkg": "test_bt", **node}}]
    assert package.diagnostics == ()
    assert text.count(ending) == text.count("\n")


@pytest.mark.parametrize(
    ("path", "raw"),
    [
        ("n.launch.yaml", b"launch:\n- executable: {cmd: python3 launch/talker.py}\n"),
        ("n.launch.yaml", b"launch: [\n- node: {exec: launch/talker.py}\n"),
        ("n.launch.py", b"import launch_ros\nNode(executable='launch/talker.py')\n"),
        ("n.launch.xml", b"<launch>\n<executable cmd='launch/talker.py'/></launch>"),
    ],
)
def test_a_program_named_in_another_way_is_reported_with_its_line(make_project, path, raw):
    package, text = launched_as(make_project, path, raw, "talker.py")
    (found,) = package.diagnostics
    assert (found.code, found.place.file, found.place.line) == ("BT0911", f"launch/{path}", 2)
    assert text.encode() == raw


def test_packages_of_launch_files_are_dependencies(make_project, tmp_path):
    files = {
        "launch/a.launch.yaml": b"launch:\n- node: {pkg: demo_nodes_py, exec: talker}\n"
        b"- include: {file: $(find-pkg-share nav2_bringup)/launch/x.launch.py}\n"
        b"- node: {pkg: of_my_workspace, exec: talker}\n",
        "launch/b.launch.xml": b'<launch><node pkg="turtlesim" exec="turtlesim_node"/></launch>',
        "launch/c.launch.py": b"from nav2_common.launch import RewrittenYaml\n"
        b"Node(package='joy', executable='joy_node')\nFindPackageShare('slam_toolbox')\n",
    }
    package = to_ros2_package(make_project(LEAF, files=files))
    assert package.diagnostics == ()
    names = {item.name for item in parsed(package, tmp_path).exec_depends}
    assert names >= {"demo_nodes_py", "nav2_bringup", "turtlesim", "nav2_common", "joy", "slam_toolbox"}
    assert names >= {"launch_yaml", "launch_xml"}
    assert "of_my_workspace" not in names


def test_files_of_the_same_name_in_folders_of_launch_stay_apart(make_project):
    paths = ["a/n.launch.py", "b/n.launch.py", "a/b.py", "a_b.py", "a/params.yaml", "robot.rviz"]
    files = {f"launch/{path}": f"# {path}\n".encode() for path in paths}
    package = to_ros2_package(make_project(LEAF, files=files))
    for path in ("a/n.launch.py", "b/n.launch.py", "a/params.yaml", "robot.rviz"):
        assert package.files[f"test_bt/launch/{path}"] == f"# {path}\n".encode()
    programs = {path: raw for path, raw in package.files.items() if "/scripts/" in path}
    assert {path: raw.splitlines()[-1] for path, raw in programs.items()} == {
        "test_bt/scripts/a_b.py": b"# a/b.py",
        "test_bt/scripts/_a_b.py": b"# a_b.py",
    }
    setup = package.files["test_bt/setup.py"].decode()
    assert "('share/test_bt/launch/a', ['launch/a/n.launch.py', 'launch/a/params.yaml'])" in setup


ENDS = """TFMessage = object
import py_trees
from geometry_msgs.msg import Twist
from sensor_msgs.msg import LaserScan


class Act(py_trees.behaviour.Behaviour):
    def setup(self, **kwargs):
        node = kwargs["node"]
        node.create_publisher(Twist, "/cmd_vel", 10)
        node.create_publisher(Twist, "/a|b", 10)
        node.create_subscription(LaserScan, "scan", print, 10)
        node.create_subscription(LaserScan, self.ports["topic"], print, 10)
        node.create_publisher(TFMessage, "/tf", 10)
        node.declare_parameter("gain", 2.0)

    def update(self):
        return py_trees.common.Status.SUCCESS
"""


def test_the_readme_lists_what_the_actions_open(make_project):
    package = to_ros2_package(make_project(LEAF, actions={"Act": ENDS}))
    readme = package.files["test_bt/README.md"].decode()
    assert "| `/cmd_vel` | `geometry_msgs/msg/Twist` | publishes | Act |" in readme
    assert "| `/a\\|b` | `geometry_msgs/msg/Twist` | publishes | Act |" in readme
    assert "| `scan` | `sensor_msgs/msg/LaserScan` | subscribes to | Act |" in readme
    assert "| `/tf` | `not stated in the source` | publishes | Act |" in readme
    assert "* actions/Act.py, line 13: subscribes to `self.ports['topic']` of type `sensor_msgs" in readme
    assert "| `gain` | `2.0` | declared by Act |" in readme
    assert 'remaps:="/cmd_vel:=/my_robot/cmd_vel"' in readme
    assert "--ros-args -r /cmd_vel:=/my_robot/cmd_vel" in readme
    text = package.files["test_bt/launch/test_bt.launch.py"].decode()
    names = ast.literal_eval(text.partition("ABSOLUTE_NAMES = ")[2].partition("]")[0] + "]")
    assert names == ["/a|b", "/cmd_vel"]


def test_parameters_reach_every_node_and_are_those_of_the_project(make_project):
    package = to_ros2_package(make_project(LEAF, tick_hz=12.5, on_finish="repeat", on_error="failure"))
    params = yaml.safe_load(package.files["test_bt/config/params.yaml"])
    values = {
        "tick_hz": 12.5,
        "on_finish": "repeat",
        "on_error": "failure",
        "groot2_port": 0,
        "use_sim_time": False,
    }
    assert params == {"/**": {"ros__parameters": values}}


def test_only_the_engine_names_where_the_package_comes_from(make_project):
    files = {"launch/talker.py": b"import rclpy\n"}
    for path, raw in to_ros2_package(make_project(LEAF, files=files)).files.items():
        if not path.startswith("tree_gardener/"):
            assert not re.search(rb"bt[ _-]?studio", raw, re.IGNORECASE), path


@pytest.mark.parametrize(
    ("title", "name"),
    [
        ("Laser bump and go", "laser_bump_and_go"),
        ("  Ünïcode — Röbot 2 ", "unicode_robot_2"),
        ("2 wheels", "robot_2_wheels"),
        ("名前", "robot_bt"),
        ("", "robot_bt"),
        ("class", "class_bt"),
        ("test", "test_bt"),
        ("rclpy", "rclpy_bt"),
        ("numpy", "numpy_bt"),
        ("random", "random_bt"),
        ("tree_gardener", "tree_gardener_bt"),
        ("x", "x_bt"),
        ("a__b", "a_b"),
        ("a" * 300, "a" * 80),
    ],
)
def test_names_of_packages(title, name):
    assert package_name(title) == name
    assert problem_with(name) is None


@pytest.mark.parametrize(
    "name", ["Upper", "1st", "with space", "a-b", "a__b", "x", "rclpy", "import", "../up", "a_"]
)
def test_name_that_a_user_chose_is_refused_with_a_better_one(make_project, name):
    with pytest.raises(TranslatorError) as error:
        to_ros2_package(make_project(LEAF), name=name)
    assert error.value.diagnostics[0].code == "BT0900"


def test_errors_keep_a_project_from_being_packed(make_project):
    with pytest.raises(TranslatorError) as error:
        to_ros2_package(make_project({"n1": {"type": "Nope"}}))
    assert error.value.diagnostics[0].code == "BT0102"


def test_version_of_the_engine_is_that_of_its_source():
    assert engine_version() == __version__


OWN = """from tree_gardener import ControlNode, Port, Status


class Own(ControlNode):
    MAX_CHILDREN = 2
    OUTPUT_PORTS = {"chosen": Port(int)}

    def update(self):
        self.set_output("chosen", self.child_count - 1)
        return self.tick_child(self.child_count - 1)
"""
TICK = """import sys
import tree_gardener
assert tree_gardener.__file__.startswith(sys.argv[1]), tree_gardener.__file__
tree = tree_gardener.Tree.from_file(sys.argv[2])
tree.setup(node=None)
print(tree.tick_exactly_once().name, tree.blackboard["at"], [node.status.name for node in tree.nodes])
from tree_gardener.nav2 import NODES
print(len(NODES))
"""


def test_own_control_nodes_travel_and_run_with_the_engine_of_the_package(make_project, tmp_path):
    nodes = {
        "n1": {"type": "Own", "ports": {"chosen": "{at}"}, "children": ["a", "b"]},
        "a": {"type": "AlwaysFailure"},
        "b": {"type": "AlwaysSuccess"},
    }
    package = to_ros2_package(make_project(nodes, actions={"Own": OWN}))
    assert package.files["test_bt/test_bt/actions/Own.py"] == OWN.encode()
    xml = package.files["test_bt/trees/test_bt.xml"].decode()
    assert '<Control ID="Own">' in xml
    assert '<output_port name="chosen" type="int"/>' in xml
    assert "'tree_gardener.nav2'" in package.files["tree_gardener/setup.py"].decode()
    for path, raw in package.files.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_bytes(raw)
    engine = str(tmp_path / "tree_gardener")
    done = subprocess.run(
        [sys.executable, "-c", TICK, engine, str(tmp_path / "test_bt/trees/test_bt.xml")],
        env={**os.environ, "PYTHONPATH": engine},
        cwd=tmp_path,
        text=True,
        capture_output=True,
        check=False,
    )
    assert done.stderr == ""
    assert done.stdout.splitlines() == ["SUCCESS 1 ['IDLE', 'IDLE', 'SUCCESS']", "81"]
