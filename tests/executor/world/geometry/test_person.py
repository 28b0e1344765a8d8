"""The parts of a person."""

from __future__ import annotations

from executor.world.geometry.person import person_parts


def test_a_person_stands_on_the_ground_and_is_175_cm_tall() -> None:
    parts = {part.name: part for part in person_parts([1.0, 0.0, 0.0, 1.0])}
    assert set(parts) == {"body", "left_leg", "right_leg", "left_arm", "right_arm"}
    tops = [
        part.hinge[2] + shape.pose[2] + max(shape.size[:1])
        for part in parts.values()
        for shape in part.shapes
    ]
    assert 1.65 < max(tops) < 1.85
    assert parts["left_leg"].sign == -parts["right_leg"].sign == -parts["left_arm"].sign


def test_clothes_have_the_colour() -> None:
    body = next(part for part in person_parts([0.0, 1.0, 0.0, 1.0]) if part.name == "body")
    assert body.shapes[0].color == [0.0, 1.0, 0.0, 1.0]
    assert body.capsule is not None
