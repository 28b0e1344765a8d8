"""Names of ROS packages."""

from __future__ import annotations

import pytest
from catkin_pkg.package import InvalidPackage, Person

from translator import TranslatorError
from translator.package.naming import maintainer_problems, package_name, problem_with, require_name
from translator.settings import Maintainer, Settings


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


@pytest.mark.parametrize("email", ["", "ada@example.org", "a-b.c+d%e_f@x-y.co.uk"])
def test_an_address_that_ros_reads_is_taken(email: str) -> None:
    assert maintainer_problems(Settings(maintainer=Maintainer(name="Ada", email=email))) == []


@pytest.mark.parametrize(
    "email", ["ada", "ada@localhost", "ada@ex ample.org", ".ada@example.org", "ad\u00e1@a.org"]
)
def test_an_address_that_ros_refuses_is_an_error(email: str) -> None:
    with pytest.raises(InvalidPackage):
        Person("Ada", email=email).validate()
    [found] = maintainer_problems(Settings(maintainer=Maintainer(name="Ada", email=email)))
    assert (found.code, found.is_error) == ("BT0901", True)
