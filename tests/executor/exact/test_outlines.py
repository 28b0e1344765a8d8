"""Outlines of a world from above."""

from __future__ import annotations

from typing import Any

import pytest

from executor.exact.outlines import outlines_of
from executor.stream_messages import Scene, SceneObject, Shape
from executor.trying_events import MOST_OUTLINES

HERE = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
TURNED = [1.0, 2.0, 0.0, 0.0, 0.0, 2**-0.5, 2**-0.5]


def scene(*shapes: Shape, kind: Any = "static", pose: list[float] = HERE) -> Scene:
    thing = SceneObject(0, "thing", "", kind, list(shapes), pose)
    return Scene("room", 0.0, [thing], {}, [], [], [])


def test_a_box_that_is_turned_and_moved_has_its_corners() -> None:
    box = Shape("box", [2.0, 1.0, 1.0], HERE, [])
    (outline,) = outlines_of(scene(box, pose=TURNED))
    assert sorted(outline) == [(0.5, 1.0), (0.5, 3.0), (1.5, 1.0), (1.5, 3.0)]


def test_round_shapes_have_sixteen_corners() -> None:
    for shape in (Shape("cylinder", [0.5, 1.0], HERE, []), Shape("sphere", [0.5], HERE, [])):
        (outline,) = outlines_of(scene(shape))
        assert len(outline) == 16
        assert all(x * x + y * y == pytest.approx(0.25, abs=1e-3) for x, y in outline)


def test_ground_ceilings_and_robots_have_none() -> None:
    flat = Shape("box", [2.0, 1.0, 0.01], HERE, [])
    plane = Shape("plane", [2.0, 1.0], HERE, [])
    ceiling = Shape("box", [2.0, 1.0, 1.0], HERE, [], ceiling=True)
    assert outlines_of(scene(flat, plane, ceiling)) == []
    assert outlines_of(scene(Shape("box", [2.0, 1.0, 1.0], HERE, []), kind="robot")) == []


def test_there_are_not_too_many() -> None:
    box = Shape("box", [2.0, 1.0, 1.0], HERE, [])
    assert len(outlines_of(scene(*[box] * (MOST_OUTLINES + 5)))) == MOST_OUTLINES
