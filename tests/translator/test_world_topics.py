"""The topics of the world that a project runs in."""

from __future__ import annotations

from dataclasses import replace

import pytest

from translator.world_topics import world_of

TWO = b"""robots:
  - {id: a, model: waffle, topics: {camera: /eye}, ground_truth: true}
  - {id: b, model: burger}
"""


def test_a_second_robot_has_its_name_before_its_topics(make_project):
    project = make_project({"n1": {"type": "AlwaysSuccess"}})
    settings = project.settings.model_copy(update={"universe": "own"})
    world = world_of(replace(project, settings=settings, files={"universes/own.yaml": TWO}))
    assert world is not None
    topics = {each.topic: each for each in world.published}
    assert {"/eye", "/ground_truth/odom", "/b/scan", "/b/odom", "/bumper/left", "/map"} <= topics.keys()
    assert not {"/camera/image_raw", "/b/ground_truth/odom", "/b/eye"} & topics.keys()
    assert (topics["/eye"].sensor, topics["/b/scan"].sensor) == ("camera", "")
    assert "/navigate_to_pose" in world.served
    assert world.path == "universes/own.yaml"


@pytest.mark.parametrize(
    ("universe", "robot"),
    [
        ("{id: a, model: waffle, topics: {scan: , camera: 5, imu: [1]}}", ""),
        ("{model: waffle}", ""),
        ("{id: a, model: own}", "sensors: [{kind: lidar, aliases: 3}, {kind: camera, name: [1], topic: {}}]"),
        ("{id: a, model: own}", "sensors: [{kind: lidar, topic: , aliases: [2, /b]}]"),
        ("{id: a, model: own}", "sensors: [{kind: [x]}]"),
        ("{id: a, model: [own]}", ""),
    ],
)
def test_what_is_written_wrongly_or_only_half_is_left_to_the_check_of_its_file(make_project, universe, robot):
    project = make_project({"n1": {"type": "AlwaysSuccess"}})
    settings = project.settings.model_copy(update={"universe": "own"})
    texts = {"universes/own.yaml": f"robots: [{universe}]", "robots/own/robot.yaml": robot}
    files = {path: text.encode() for path, text in texts.items() if text}
    world = world_of(replace(project, settings=settings, files=files))
    assert world is None or all(isinstance(each.topic, str) for each in world.published)


def test_a_world_that_cannot_be_read_is_none(make_project):
    project = make_project({"n1": {"type": "AlwaysSuccess"}})
    settings = project.settings.model_copy(update={"universe": "unknown"})
    assert world_of(replace(project, settings=settings)) is None
