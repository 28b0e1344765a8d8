"""Cameras by the names that clients use."""

from types import SimpleNamespace
from typing import Any

from executor.world.sensing.cameras import find_camera


def robot(robot_id: str, *cameras: str) -> Any:
    config = SimpleNamespace(cameras=[SimpleNamespace(name=name) for name in cameras])
    return SimpleNamespace(id=robot_id, config=config)


def world(*robots: Any) -> Any:
    return SimpleNamespace(robots=robots)


def found(name: str, *robots: Any) -> tuple[str, str, str] | None:
    camera = find_camera(world(*robots), name)
    return camera and (camera[0], camera[1].id, camera[2].name)


def test_cameras_of_the_first_robot_have_their_own_names() -> None:
    assert found("rear", robot("one", "front", "rear")) == ("rear", "one", "rear")


def test_cameras_of_other_robots_have_its_name_before_theirs() -> None:
    robots = robot("one", "front"), robot("two", "front")
    assert found("front", *robots) == ("front", "one", "front")
    assert found("two/front", *robots) == ("two/front", "two", "front")
    assert found("one/front", *robots) is None


def test_no_name_is_the_first_camera_of_the_world() -> None:
    assert found("", robot("blind"), robot("two", "front")) == ("two/front", "two", "front")
    assert found("") is None
