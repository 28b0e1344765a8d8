"""The robots of a project, as `bt-studio check` reads them."""

from __future__ import annotations

from backend.cli.shared.robots import check_robots
from executor.robots import load_robot
from tests.executor.expansion.probes import probes, robot_of, was_refused


def test_a_project_without_robots_has_nothing_to_say() -> None:
    assert check_robots({"robots/readme.md": b""}) == ([], [])


def test_a_sound_robot_and_a_wrong_one_are_distinguished() -> None:
    shipped = load_robot("turtle2").urdf_path
    config = shipped.with_name("robot.yaml").read_bytes()
    files = {
        "robots/mine/robot.yaml": config,
        "robots/mine/turtle2.urdf": shipped.read_bytes(),
        "robots/bad/robot.yaml": config,
    }
    errors, notes = check_robots(files)
    assert notes == []
    [error] = errors
    assert error.startswith("robots/bad/turtle2.urdf:1:1: BTR002 the file cannot be read")


def test_what_a_run_does_not_find_the_check_does_not_find():
    """A run gives its robots no other folder of the project."""
    text = '<robot name="r" xmlns:xacro="http://x">\n<xacro:include filename="$(find p)/x.xacro"/></robot>'
    package = {"package.xml": b"<package><name>p</name></package>", "x.xacro": b"<robot/>"}
    inside = {f"robots/p/{name}": data for name, data in package.items()}
    outside = {f"p/{name}": data for name, data in package.items()}
    for files, message in ((inside, "no link"), (outside, "no folder is the package 'p'")):
        errors, _ = check_robots(robot_of(text) | files)
        assert (message in errors[0]) is (files is outside)


def test_no_macro_reads_outside_of_the_project(tmp_path):
    (tmp_path / "secret.yaml").write_text("word: hidden")
    for probe in probes(tmp_path / "secret.yaml"):
        [error], _ = check_robots(robot_of(probe))
        assert error.startswith("robots/r/r.xacro:2:1: BTR002 xacro: ")
        assert was_refused(error)
