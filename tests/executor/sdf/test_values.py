"""Values have the defaults of the specification."""

from __future__ import annotations

import json
import math

import pytest
from lxml import etree

from executor.sdf.dialect import SdfError
from executor.sdf.values import DEFAULTS, NO_INERTIA, NO_INERTIAL_MASS, is_true, numbers, pose_in
from executor.world.geometry.transforms import to_xyz_rpy
from tests.tools.sdf_oracle.__main__ import DEFAULTS as STORED
from tests.tools.sdf_oracle.__main__ import SPECIFICATION, defaults_in

NEWER = {"cone", "mimic"}
"""Elements of versions 1.11 and 1.12: https://sdformat.org/spec, `cone_shape` and `joint`."""


def test_defaults_are_those_of_the_specification() -> None:
    stored = json.loads(STORED.read_text())
    there = defaults_in(SPECIFICATION) if SPECIFICATION.is_dir() else stored
    assert there == stored
    for (element, child), values in DEFAULTS.items():
        if element not in NEWER:
            assert tuple(map(float, stored[f"{element}.{child}"].split())) == values, (element, child)
    assert float(stored["inertial.mass"]) == NO_INERTIAL_MASS
    assert {key: float(stored[f"inertia.{key}"]) for key in NO_INERTIA} == NO_INERTIA


def element(text: str) -> etree._Element:
    return etree.fromstring(text)


def test_what_is_missing_or_empty_has_its_default() -> None:
    for text in ("<sphere/>", "<sphere><radius/></sphere>", "<sphere><radius> </radius></sphere>"):
        assert numbers(element(text), "radius", 1, "a") == [1.0]
    assert numbers(element("<light/>"), "direction", 3, "a") == [0, 0, -1]


@pytest.mark.parametrize("text", ["1 2", "1 2 3 4", "a b c", "nan 0 0", "inf 0 0"])
def test_other_numbers_are_refused(text: str) -> None:
    with pytest.raises(SdfError, match=r"a:2: <size> needs 3 numbers"):
        numbers(element(f"<box>\n<size>{text}</size></box>"), "size", 3, "a")


def test_truth_is_read_as_gazebo_reads_it() -> None:
    texts = {"true": True, "True": True, " 1 ": True, "false": False, "0": False, "yes": False, "": False}
    assert {text: is_true(element(f"<m><static>{text}</static></m>"), "static") for text in texts} == texts
    assert is_true(element("<m/>"), "gravity", default=True)


def test_poses_turn_as_they_say() -> None:
    turned = pose_in(element("<pose degrees='true'>1 2 3 10 20 30</pose>"), "a")
    assert to_xyz_rpy(turned) == pytest.approx((1, 2, 3, *map(math.radians, (10, 20, 30))))
    quaternion = pose_in(element("<pose rotation_format='quat_xyzw'>1 2 3 0 0 2 2</pose>"), "a")
    assert to_xyz_rpy(quaternion) == pytest.approx((1, 2, 3, 0, 0, math.pi / 2))
    assert pose_in(None, "a") == pose_in(element("<pose/>"), "a")
