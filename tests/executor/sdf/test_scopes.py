"""Poses are where libsdformat has them: its answers are stored, and asked again where it is installed."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING

import pytest

from executor.sdf.dialect import SdfError
from executor.sdf.files import MemoryFiles
from executor.sdf.includes import load
from executor.sdf.scopes import Scope
from executor.world.geometry.transforms import IDENTITY, Pose, compose
from tests.tools.sdf_oracle.__main__ import STORED
from tests.tools.sdf_oracle.build import Answer, ask, is_there
from tests.tools.sdf_oracle.random_worlds import CONFIG, COUNT, PART, world_of

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

FILES = {"models/part/model.sdf": PART.encode(), "models/part/model.config": CONFIG.encode()}
AGAIN = 40
"""Worlds that are asked about again where libsdformat is installed."""


def ours(text: str) -> dict[str, Pose]:
    skipped: list[str] = []
    root = load(text.encode(), "w.sdf", MemoryFiles(FILES), lambda _, message: skipped.append(message))
    element = root.find("world")
    assert element is not None
    assert not skipped
    world = Scope(element)
    found = {f"light {light.get('name')}": world.pose_of(light) for light in element.findall("light")}
    for name, model in world.models.items():
        found.update(_of(model, compose(IDENTITY, world.frame(name)), ""))
    return found


def _of(model: Scope, pose: Pose, above: str) -> Iterator[tuple[str, Pose]]:
    path = f"{above}{model.name}"
    yield f"model {path}", pose
    for name in model.links:
        yield f"link {path}::{name}", compose(pose, model.frame(name))
    for name, inner in model.models.items():
        yield from _of(inner, compose(pose, model.frame(name)), f"{path}::")


def apart(one: Pose, other: list[float]) -> float:
    """Returns the larger of the distance in m, and that of the quaternions q and ±q."""
    turns = (math.dist(one[3:], [sign * value for value in other[3:]]) for sign in (1, -1))
    return max(math.dist(one[:3], other[:3]), min(turns))


def compare(number: int, answer: Answer) -> None:
    found = ours(world_of(number))
    assert found.keys() == answer.keys(), number
    wrong = {
        name: apart(pose, answer[name]) for name, pose in found.items() if apart(pose, answer[name]) > 1e-6
    }
    assert not wrong, (number, wrong)


def test_poses_are_those_of_libsdformat() -> None:
    stored: dict[str, Answer] = json.loads(STORED.read_text())
    assert len(stored) == COUNT
    read = [number for number in range(COUNT) if stored[f"{number}.sdf"]]
    assert len(read) > COUNT * 0.9
    for number in read:
        compare(number, stored[f"{number}.sdf"])


def test_the_stored_answers_are_those_of_the_installed_libsdformat(tmp_path: Path) -> None:
    worlds = {f"{number}.sdf": world_of(number) for number in range(AGAIN)}
    stored: dict[str, Answer] = json.loads(STORED.read_text())
    answers = ask(worlds, tmp_path) if is_there() else {name: stored[name] for name in worlds}
    for name, answer in answers.items():
        assert answer.keys() == stored[name].keys()
        for key, pose in answer.items():
            assert pose == pytest.approx(stored[name][key], abs=1e-7)


def scope(inside: str) -> Scope:
    text = f"<sdf version='1.9'><world name='w'>{inside}</world></sdf>"
    root = load(text.encode(), "w.sdf", MemoryFiles({}), lambda *_: None)
    element = root.find("world")
    assert element is not None
    return Scope(element)


@pytest.mark.parametrize(
    ("inside", "name", "message"),
    [
        ("<frame name='a'><pose relative_to='b'/></frame><frame name='b' attached_to='a'/>", "a", "circle"),
        ("<frame name='a'><pose relative_to='x'/></frame>", "a", "'x' does not exist"),
        ("<model name='m'/>", "m::x", "'x' does not exist"),
        ("<frame name='a'><pose>1 2</pose></frame>", "a", "6 numbers"),
        ("<frame name='a'><pose rotation_format='quat_xyzw'>0 0 0 0 0 0 0</pose></frame>", "a", "quaternion"),
    ],
)
def test_frames_that_mean_nothing_are_refused(inside: str, name: str, message: str) -> None:
    with pytest.raises(SdfError, match=message) as refused:
        scope(inside).frame(name)
    assert refused.value.problem.line == 1


def test_a_frame_leads_to_its_link() -> None:
    model = scope(
        "<model name='m'><link name='a'/><frame name='f' attached_to='a'/><frame name='g' attached_to='f'/>"
        "<model name='n'><link name='b'/></model><frame name='h' attached_to='n::b'/></model>"
    ).models["m"]
    found = {name: model.link_of(name, model.element) for name in ("a", "g", "__model__", "h", "n", "world")}
    assert {name: link and (link[0].name, link[1]) for name, link in found.items()} == {
        "a": ("m", "a"),
        "g": ("m", "a"),
        "__model__": ("m", "a"),
        "h": ("n", "b"),
        "n": ("n", "b"),
        "world": None,
    }
