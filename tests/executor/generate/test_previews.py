"""Each universe and robot has a picture for the chooser, of the right size and not empty."""

from pathlib import Path

import cv2
import numpy as np
import pytest

from executor.generate import previews
from executor.render import make_renderer
from executor.robots import robot_ids
from executor.robots.config import preview_path as robot_preview
from executor.universes import BUILTIN_IDS
from executor.universes.loader import preview_path as universe_preview

COMMITTED = [universe_preview(name) for name in BUILTIN_IDS] + [robot_preview(name) for name in robot_ids()]


@pytest.mark.parametrize("path", COMMITTED, ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_each_has_a_small_picture_that_is_not_empty(path: Path) -> None:
    data = path.read_bytes()
    picture = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR)
    assert len(data) <= previews.MOST_BYTES
    assert picture.shape == (270, 480, 3)
    assert picture.std() > 5


def test_each_example_with_a_world_of_its_own_has_a_picture() -> None:
    shown = {path.stem: path.read_bytes() for path in previews.EXAMPLE_PICTURES.iterdir()}
    assert shown.keys() == previews.own_universes().keys()
    for data in shown.values():
        picture = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR)
        assert (picture.shape, picture.std() > 5) == ((270, 480, 3), True)


def test_there_is_no_picture_of_what_is_gone() -> None:
    folder = universe_preview("empty").parent
    assert sorted(path.stem for path in folder.iterdir()) == sorted(BUILTIN_IDS)


def test_a_committed_picture_is_what_the_command_draws(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(previews, "universe_preview", lambda name: tmp_path / f"{name}.webp")
    previews.main(["football"])
    assert "football.webp" in capsys.readouterr().out
    drawn, committed = (
        cv2.imread(str(path), cv2.IMREAD_COLOR).astype(int)
        for path in (tmp_path / "football.webp", universe_preview("football"))
    )
    assert np.abs(drawn - committed).mean() < 6  # another GPU may shade slightly differently


def test_a_robots_picture_has_the_robot_in_it() -> None:
    renderer = make_renderer()
    picture = cv2.imdecode(
        np.frombuffer(previews.robot_picture(renderer, "turtle2"), np.uint8), cv2.IMREAD_COLOR
    )
    renderer.close()
    middle = picture[90:200, 200:280]
    assert (middle.max(axis=2) < 90).mean() > 0.2
