"""The objects of a scene and their poses."""

from __future__ import annotations

from executor.world.geometry.objects import SceneObjects, Where
from executor.world.geometry.transforms import IDENTITY, Pose

FAR: Pose = (1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 1.0)


def test_objects_are_numbered_and_movers_say_where_they_are() -> None:
    objects = SceneObjects()
    box = objects.add("box", "", "static", [], IDENTITY)
    robot = objects.add("robot", "base", "robot", [], IDENTITY)
    objects.add_mover(lambda: lambda: [(robot, FAR)])
    assert (box, robot) == (0, 1)
    assert objects.update()[robot].tolist() == list(FAR)
    assert objects.update()[box].tolist() == list(IDENTITY)


def test_the_last_array_does_not_change_with_the_next() -> None:
    objects = SceneObjects()
    box = objects.add("box", "", "static", [], IDENTITY)
    before = objects.update()
    objects.place(box, FAR)
    assert before[box].tolist() == list(IDENTITY)
    assert objects.update()[box].tolist() == list(FAR)
    objects.tell(objects.update())
    assert objects.objects[box].pose == list(FAR)


def test_poses_that_were_read_are_computed_later_as_they_were() -> None:
    objects, at = SceneObjects(), [IDENTITY]
    box = objects.add("box", "", "static", [], IDENTITY)
    robot = objects.add("robot", "base", "robot", [], IDENTITY)

    def read() -> Where:
        pose = at[0]
        return lambda: [(robot, pose)]

    objects.add_mover(read)
    before = objects.read()
    at[0] = FAR
    objects.place(box, FAR)
    after = objects.read()
    assert before().tolist() == [list(IDENTITY)] * 2
    assert after().tolist() == [list(FAR)] * 2
