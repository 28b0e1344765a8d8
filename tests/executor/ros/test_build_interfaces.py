"""Message packages without a wheel: their definitions, their use, and the message when they are missing."""

import importlib
import math
from pathlib import Path
from typing import Any

import pytest
from rclpy.context import Context
from rclpy.node import Node
from rclpy.serialization import deserialize_message, serialize_message

from executor.ros import build_interfaces
from executor.ros.interface_definitions import FOLDER, PACKAGES, definitions_of, needed_by

# From the definitions of the releases that `interfaces/NOTICE` names, by rosidl's own generator.
HASHES = {
    "nav2_msgs/msg/Costmap": "d51bf7aecafdbb3f8f98215de648abe6d53f8db69156d6e143125d2ad2bf0027",
    "vision_msgs/msg/Detection2DArray": "214274120007f4a683866481336b70310268cfa107aebe9d594a6acf75bda968",
    "control_msgs/msg/DynamicJointState": "18024c98a62697680f581108eeed40b28fb4542fa0ac5a8e36f56c62b6813d26",
    "btcpp_ros2_interfaces/msg/NodeStatus": (
        "1e7532580fcbed917d24505c580999050a56c20fcec7f77c228171864418c261"
    ),
    "geographic_msgs/msg/GeoPoseStamped": "a8e603c050fa992a74283bb462a96fe9d2b151b7a67b14d77250ed7cb4ed96b7",
}


def interfaces(kind: str) -> list[tuple[str, str]]:
    return [
        (package, path.partition("/")[2].partition(".")[0])
        for package in PACKAGES
        for path in definitions_of(package)
        if path.startswith(f"{kind}/")
    ]


def of(package: str, kind: str, name: str) -> Any:
    return getattr(importlib.import_module(f"{package}.{kind}"), name)


def test_all_are_built_and_a_second_time_there_is_nothing_to_do(capsys: pytest.CaptureFixture[str]) -> None:
    assert build_interfaces.missing() == []
    build_interfaces.main()
    assert "nav2_msgs" in capsys.readouterr().out
    assert build_interfaces.COMPLETE.is_file()


@pytest.mark.parametrize(("package", "name"), interfaces("msg"))
def test_each_message_survives_the_wire(package: str, name: str) -> None:
    kind = of(package, "msg", name)
    message = kind()
    for field, written in kind.get_fields_and_field_types().items():
        if written in {"double", "float"}:
            setattr(message, field, 1.5)
        elif written == "string":
            setattr(message, field, "ä")
    assert deserialize_message(serialize_message(message), kind) == message


@pytest.mark.parametrize(("package", "name"), interfaces("srv"))
def test_each_service_has_its_two_messages(package: str, name: str) -> None:
    service = of(package, "srv", name)
    for part in (service.Request, service.Response):
        assert deserialize_message(serialize_message(part()), part) == part()


@pytest.mark.parametrize(("package", "name"), interfaces("action"))
def test_each_action_has_its_three_messages(package: str, name: str) -> None:
    action = of(package, "action", name)
    for part in (action.Goal, action.Result, action.Feedback):
        assert deserialize_message(serialize_message(part()), part) == part()


def test_constants_and_defaults_are_there() -> None:
    from control_msgs.msg import VDA5050SafetyState
    from nav2_msgs.action import FollowObject

    assert (FollowObject.Result.NONE, FollowObject.Result.TF_ERROR) == (0, 901)
    assert FollowObject.Feedback.RETRY == 4
    assert FollowObject.Feedback.NONE == 0, "of the same name as one of the result"
    assert VDA5050SafetyState.AUTO_ACK == "autoAck"
    assert not math.isnan(FollowObject.Result().error_code)


def test_each_package_names_its_source() -> None:
    notice = (FOLDER / "NOTICE").read_text(encoding="utf-8")
    for package in PACKAGES:
        version = (FOLDER / f"{package}.txt").read_text(encoding="utf-8").splitlines()[0].split()[-1]
        assert any(line.split()[:2] == [package, version] for line in notice.splitlines()), package
    assert {path.stem for path in FOLDER.glob("*.txt")} == set(PACKAGES)
    assert "geometry_msgs" in needed_by("nav2_msgs")


@pytest.mark.parametrize("lacking", ["cc", "Python.h"])
def test_without_a_compiler_a_sentence_explains_what_to_do(
    lacking: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(build_interfaces, "missing", lambda: ["tf2_msgs", "nav2_msgs"])
    monkeypatch.setattr(build_interfaces, "COMPLETE", tmp_path / "complete")
    (tmp_path / "complete").touch()
    if lacking == "cc":
        monkeypatch.setenv("PATH", str(tmp_path))
    else:
        monkeypatch.setattr("sysconfig.get_path", lambda _: str(tmp_path))
    build_interfaces.main()
    said = capsys.readouterr().out
    assert said.startswith("tf2_msgs and nav2_msgs were not built, so they and /tf are left out: ")
    assert "apt-get install" in said
    assert len(said.splitlines()) == 1
    assert not (tmp_path / "complete").exists(), "so that set-up tries again"


def test_changed_packages_are_built_again(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    for path in FOLDER.glob("*.txt"):
        (tmp_path / path.name).write_bytes(path.read_bytes())
    monkeypatch.setattr(build_interfaces, "FOLDER", tmp_path)
    assert build_interfaces.missing() == []
    (tmp_path / "geographic_msgs.txt").write_text("# other\n")
    assert build_interfaces.missing() == ["geographic_msgs", "nav2_msgs"], "and those that use it"


def test_others_see_the_type_that_they_know(context: Context) -> None:
    node = Node("types", context=context)
    for written, expected in HASHES.items():
        package, _, name = written.split("/")
        node.create_publisher(of(package, "msg", name), f"/hash/{name}", 1)
        [end] = node.get_publishers_info_by_topic(f"/hash/{name}")
        assert str(end.topic_type_hash) == f"RIHS01_{expected}", written
    node.destroy_node()
