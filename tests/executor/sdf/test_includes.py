"""Includes are replaced by what they name."""

from __future__ import annotations

from lxml import etree

from executor.sdf.files import MemoryFiles
from executor.sdf.includes import MAX_LEVELS, file_of, is_before, load, problem_at


def loaded(inside: str, files: dict[str, str], version: str = "1.9"):
    said: list[str] = []
    text = f"<sdf version='{version}'><world name='w'>{inside}</world></sdf>"
    stored = {path: raw.encode() for path, raw in files.items()}
    root = load(text.encode(), "w.sdf", MemoryFiles(stored), lambda _, message: said.append(message))
    world = root.find("world")
    assert world is not None
    return world, said


CRATE = (
    "<sdf version='1.6'>\n<model name='crate'><static>0</static><pose>1 0 0 0 0 0</pose><link name='l'/>"
    "</model></sdf>"
)


def test_name_pose_and_static_are_those_of_the_include() -> None:
    place = "<name>a</name><static>true</static><pose frame='f'>2 0 0 0 0 0</pose>"
    world, said = loaded(f"<include><uri>crate</uri>{place}</include>", {"crate/model.sdf": CRATE}, "1.6")
    [model] = world
    assert not said
    assert model.get("name") == "a"
    assert [(e.text, e.get("relative_to")) for e in model.findall("pose")] == [("2 0 0 0 0 0", "f")]
    assert [e.text for e in model.findall("static")] == ["true"]


def test_an_element_knows_its_file_and_version() -> None:
    world, _ = loaded("<include><uri>crate</uri></include><light name='l'/>", {"crate/model.sdf": CRATE})
    model, light = world
    assert (file_of(model[0]), file_of(light)) == ("crate/model.sdf", "w.sdf")
    assert is_before(model, 1, 7)
    assert not is_before(light, 1, 7)
    problem = problem_at(model, "wrong")
    assert (problem.line, problem.message) == (2, "crate/model.sdf: wrong")
    assert problem_at(light, "wrong").message == "wrong"


def test_lights_and_actors_are_included_too() -> None:
    files = {"sun/model.sdf": "<sdf version='1.9'><light name='sun' type='directional'/></sdf>"}
    world, said = loaded("<include><uri>model://sun</uri></include>", files)
    assert [child.tag for child in world] == ["light"]
    assert not said


def test_includes_in_models_end_somewhere() -> None:
    text = "<sdf version='1.9'><model name='m{}'><include><uri>m{}</uri></include></model></sdf>"
    files = {f"m{i}/model.sdf": text.format(i, i + 1) for i in range(40)}
    _, said = loaded("<include><uri>m0</uri></include>", files)
    assert f"more than {MAX_LEVELS} levels" in said[0]


def test_what_is_left_out_is_gone() -> None:
    world, said = loaded("<include><uri>model://ghost</uri></include><frame name='f'/>", {})
    assert [child.tag for child in world] == ["frame"]
    assert "ghost" in said[0]
    assert isinstance(world, etree._Element)


def test_the_ground_and_the_sun_of_gazebo_are_in_every_universe() -> None:
    uris = ("model://ground_plane", "https://fuel.gazebosim.org/1.0/OpenRobotics/models/sun")
    inside = "".join(f"<include><uri>{uri}</uri></include>" for uri in uris)
    world, said = loaded(inside, {})
    assert (len(world), said) == (0, [])
    files = {"sun/model.sdf": "<sdf version='1.9'><light name='s' type='directional'/></sdf>"}
    world, said = loaded(inside, files)
    assert ([child.tag for child in world], said) == (["light"], [])
