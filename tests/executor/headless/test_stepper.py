"""The steps of a world in lock-step."""

from __future__ import annotations

import random

from executor.headless.stepper import PERIOD_STEPS, Stepper
from tests.fakes.stepped_world import SteppedNode, SteppedWorld, stepped_sensors


def stepped(*untils: int) -> list[tuple[str, int]]:
    """Returns what happened on the way to several steps."""
    world = SteppedWorld()
    stepper = Stepper(world, stepped_sensors(), SteppedNode(world))  # type: ignore[arg-type]
    for until in untils:
        while stepper.done < until:
            count = stepper.count(until)
            before = stepper.done
            stepper.advance(until)
            assert stepper.done - before == count <= PERIOD_STEPS
    return world.log


def test_sensors_publish_at_each_period_and_where_the_caller_stops() -> None:
    published = [step for what, step in stepped(10, 12, 13) if what == "publish"]
    assert published == [4, 8, 10, 12, 13]


def test_ways_with_the_same_stops_are_the_same() -> None:
    stops = sorted(random.Random(3).sample(range(1, 400), 40))  # noqa: S311 - a test
    assert stepped(*stops) == stepped(*(stop for stop in stops for _ in range(2)))


def test_parts_work_before_the_sensors_publish() -> None:
    world = SteppedWorld()
    stepper = Stepper(world, stepped_sensors(), SteppedNode(world))  # type: ignore[arg-type]

    class Part:
        def poll(self, *, is_paused: bool = False) -> None:
            world.log.append(("part", world.steps))

        def restart(self) -> None:
            raise AssertionError

    stepper.parts.append(Part())
    stepper.moved = lambda: world.log.append(("moved", world.steps))
    stepper.published = lambda: world.log.append(("published", world.steps))
    stepper.advance(4)
    assert [what for what, _ in world.log] == ["step", "moved", "part", "publish", "published"]
