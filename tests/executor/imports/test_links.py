"""Visuals are compared with collisions."""

from __future__ import annotations

import pytest

from executor.imports.links import parts_of
from executor.sdf.files import NoFiles
from executor.sdf.includes import load
from executor.sdf.scopes import Scope
from executor.world.geometry.transforms import IDENTITY, from_xyz_rpy

BOX = "<geometry><box><size>1 2 3</size></box></geometry>"
BALL = "<geometry><sphere/></geometry>"


def parts(inside: str):
    text = f"<sdf version='1.9'><model name='m'><link name='l'>{inside}</link></model></sdf>"
    root = load(text.encode(), "a", NoFiles(), lambda *_: None)
    model = root.find("model")
    assert model is not None
    scope = Scope(model)
    return parts_of(scope, scope.links["l"], IDENTITY)


@pytest.mark.parametrize(
    ("visual", "collision", "is_simple", "is_touched"),
    [
        (BOX, BOX, True, True),
        (BOX, "", True, False),
        (BOX, BALL, False, False),
        (BOX, f"<pose>0 0 1 0 0 0</pose>{BOX}", False, False),
        (
            f"<pose degrees='true'>0 0 1 0 0 90</pose>{BALL}",
            f"<pose>0 0 1 0 0 1.5707963</pose>{BALL}",
            True,
            True,
        ),
        ("<geometry><cone/></geometry>", "", False, False),
        ("<geometry><plane/></geometry>", "<geometry><plane><size>9 9</size></plane></geometry>", True, True),
    ],
)
def test_a_visual_is_touched_where_a_collision_is_the_same(
    visual: str, collision: str, is_simple: bool, is_touched: bool
) -> None:
    below = f"<collision name='c'>{collision}</collision>" if collision else ""
    found = parts(f"<visual name='v'>{visual}</visual>{below}")
    assert (found.are_simple, found.seen[0].is_touched) == (is_simple, is_touched)


def test_a_large_level_plane_is_the_ground() -> None:
    plane = "<visual name='v'><geometry><plane><normal>{}</normal><size>{}</size></plane></geometry></visual>"
    found = [
        parts(plane.format(*row)).seen[0].is_ground
        for row in (("0 0 1", "50 50"), ("1 0 0", "50 50"), ("0 0 1", "5 50"))
    ]
    assert found == [True, False, False]


def test_mass_is_that_of_the_specification_and_may_lie_elsewhere() -> None:
    visual = f"<visual name='v'><pose>0 0 0.5 0 0 0</pose>{BOX}</visual>"
    assert (parts(visual).mass, parts(visual).is_centred) == (1.0, True)
    low = parts(f"<inertial><mass>4</mass></inertial>{visual}")
    assert (low.mass, low.is_centred) == (4.0, False)
    assert parts(f"<inertial><pose>0 0 0.5 0 0 0</pose></inertial>{visual}").is_centred


def test_a_link_stands_where_its_model_does() -> None:
    link = f"<link name='l'><visual name='v'>{BOX}</visual></link>"
    text = f"<sdf version='1.9'><model name='m'>{link}</model></sdf>"
    model = load(text.encode(), "a", NoFiles(), lambda *_: None).find("model")
    assert model is not None
    scope = Scope(model)
    [seen] = parts_of(scope, scope.links["l"], from_xyz_rpy((1, 2, 3, 0, 0, 0))).seen
    assert seen.pose[:3] == (1, 2, 3)
