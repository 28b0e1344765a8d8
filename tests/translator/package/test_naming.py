"""Names of ROS packages."""

from __future__ import annotations

import pytest

from translator import TranslatorError
from translator.package.naming import package_name, problem_with, require_name


@pytest.mark.parametrize(
    ("title", "name"),
    [
        ("Laser bump & go", "laser_bump_go"),
        ("Übung 1", "ubung_1"),
        ("3 robots", "robot_3_robots"),
        ("…", "robot_bt"),
    ],
)
def test_a_title_gives_a_valid_name(title: str, name: str) -> None:
    assert package_name(title) == name
    assert problem_with(name) is None


@pytest.mark.parametrize("name", ["x", "Robot", "a__b", "class", "json", "build", "rclpy", "a" * 100])
def test_a_name_that_cannot_be_is_refused_with_another(name: str) -> None:
    assert problem_with(name)
    with pytest.raises(TranslatorError) as caught:
        require_name(name)
    assert problem_with(caught.value.diagnostics[0].values["suggestion"]) is None
