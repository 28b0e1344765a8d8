"""The launch files of a project in its package."""

from __future__ import annotations

import pytest

from translator.package.launch_files import (
    as_program,
    companions,
    dependencies_of,
    in_package,
    launch_files,
    programs,
    started_files,
)

FILES = {
    "launch/a.launch.yaml": b"launch:\n- node: {exec: launch/talker.py, name: t}\n",
    "launch/b.launch.xml": b'<launch><node pkg="nav2_map_server" exec="map_server"/></launch>',
    "launch/talker.py": b"print(1)\n",
    "launch/sub/talker.py": b"#!/bin/sh\n",
    "launch/map.yaml": b"{}",
    "actions/Go.py": b"",
}


def test_launch_files_programs_and_what_lies_beside_them() -> None:
    assert launch_files(FILES) == ["launch/a.launch.yaml", "launch/b.launch.xml"]
    assert programs(FILES) == {"launch/sub/talker.py": "sub_talker.py", "launch/talker.py": "talker.py"}
    assert companions(FILES) == ["launch/map.yaml"]
    assert dependencies_of(FILES) == {"launch_yaml", "launch_xml", "nav2_map_server"}


def test_files_are_known_by_the_names_that_ros2_launch_completes() -> None:
    names = ["launch/a_launch.py", "launch/b.launch.yml", "launch/launch.xml", "launch/sub/c_launch.yaml"]
    others = ["launch/relaunch.py", "launch/params.yaml", "other/a.launch.py"]
    assert launch_files(dict.fromkeys([*names, *others], b"")) == names


def test_a_file_that_another_one_includes_is_not_started_by_itself() -> None:
    files = {
        "launch/main.launch.xml": b'<launch><include file="$(dirname)/sub/robot_launch.py"/></launch>',
        "launch/sub/robot_launch.py": b'SOURCE = os.path.join(here, "arm.launch.yaml")\n',
        "launch/sub/arm.launch.yaml": b"launch: []\n",
        "launch/other.launch.yaml": b"launch: [{include: {file: launch/third.launch.yaml}}]\n",
        "launch/third.launch.yaml": b"launch: [{include: {file: other.launch.yaml}}]\n",
    }
    ring = ["launch/other.launch.yaml", "launch/third.launch.yaml"]
    assert started_files(files) == ["launch/main.launch.xml", *ring]


def test_any_python_file_that_a_launch_file_names_is_a_program() -> None:
    files = {
        "launch/a.launch.yaml": b"launch:\n- node: {exec: nodes/beeper.py}\n",
        "nodes/beeper.py": b"",
        "nodes/other.py": b"",
    }
    assert programs(files) == {"nodes/beeper.py": "nodes_beeper.py"}
    text, found = in_package("launch/a.launch.yaml", files["launch/a.launch.yaml"], "mine", programs(files))
    assert (text, found) == (b"launch:\n- node: {pkg: mine, exec: nodes_beeper.py}\n", [])


RENAMED = b"- node: {pkg: mine, exec: talker.py}\n"


@pytest.mark.parametrize(
    ("path", "raw", "expected"),
    [
        (
            "launch/a.launch.yaml",
            b"- node: {exec: launch/talker.py}\n",
            b"- node: {pkg: mine, exec: talker.py}\n",
        ),
        ("launch/a.launch.yaml", b"- node: {exec: talker.py}\n", RENAMED),
        ("launch/a.launch.yaml", b"- node: {pkg: other, exec: x}\n", b"- node: {pkg: other, exec: x}\n"),
        (
            "launch/b.launch.xml",
            b'<launch><node exec="$(dirname)/talker.py"/></launch>',
            b'<launch><node pkg="mine" exec="talker.py"/></launch>',
        ),
    ],
)
def test_a_program_is_named_as_an_executable_of_the_package(path: str, raw: bytes, expected: bytes) -> None:
    assert in_package(path, raw, "mine", programs(FILES)) == (expected, [])


def test_a_name_that_is_not_understood_is_reported_with_its_place() -> None:
    raw = b"x = 1\nNode(executable='launch/talker.py')\n"
    _, [found] = in_package("launch/c.launch.py", raw, "mine", programs(FILES))
    assert (found.code, found.place.line) == ("BT0911", 2)


def test_a_launch_file_that_no_yaml_can_read_stays_as_it_is() -> None:
    raw = b"launch: " + b"[" * 3_000
    assert in_package("launch/c.launch.yaml", raw, "mine", programs(FILES)) == (raw, [])


def test_a_program_begins_with_its_interpreter() -> None:
    line = b"#!/usr/bin/env -S python3 -mtree_gardener.ros_script\n"
    assert as_program(b"print(1)\n") == line + b"print(1)\n"
    for own in (b"#!/usr/bin/env python3\n", b"#!/usr/bin/python3.12\n"):
        assert as_program(own + b"print(1)\n") == line + b"print(1)\n"
    assert as_program(b"#!/usr/bin/python3 -O\n") == b"#!/usr/bin/python3 -O\n"
    assert as_program(FILES["launch/sub/talker.py"]) == b"#!/bin/sh\n"
