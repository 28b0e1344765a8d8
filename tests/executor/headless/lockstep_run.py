"""Runs a project in lock-step in a process of its own, and prints its report and measurements as JSON.

With a fourth argument the debugger holds the tree before and after each node, and only continues and steps.
"""

import contextlib
import json
import math
import sys
from pathlib import Path
from typing import Any

from executor.headless.lockstep import LockstepOptions, run_lockstep
from executor.world.physics.bullet import BulletWorld
from tree_gardener import Tree
from tree_gardener.debugging import Breakpoint, Debugger, Step, Stop, When, place_of


def main() -> None:
    project, duration_s, seed = Path(sys.argv[1]), float(sys.argv[2]), int(sys.argv[3])
    ticks: list[list[Any]] = []
    stops: list[Stop] = []

    def hold(stop: Stop) -> None:
        stops.append(stop)
        debugger.resume((Step.CONTINUE, Step.INTO, Step.OVER, Step.OUT)[len(stops) % 4])

    debugger = Debugger(hold)

    def note(_node: Any, status: Any) -> None:
        ticks[-1][2] = status.name == "SUCCESS"

    def watch(world: BulletWorld, tree: Tree) -> None:
        if not ticks and len(sys.argv) > 4:
            tree.debug(debugger)
            places = [place_of(node) for node in tree.nodes]
            moments = (When.BEFORE, When.AFTER, When.HALTED)
            debugger.set_breakpoints([Breakpoint(place, when) for place in places for when in moments])
        if not ticks:
            for node in tree.nodes:
                if node.type == "DetectPerson":
                    tree.add_hook(after=note, node=node)
        x, y, _ = world.robots[0].pose
        away = [math.dist((x, y), actor.position) for actor in world.actors]
        ticks.append([world.time_s, away[0] if away else None, None])

    with contextlib.redirect_stdout(sys.stderr):
        report = run_lockstep(project, LockstepOptions(duration_s=duration_s, seed=seed), watch=watch)
    found = {"report": report.to_json(), "same": report.without_wall_times(), "ticks": ticks}
    print(json.dumps(found | {"stops": len(stops)}))  # noqa: T201 - the result


if __name__ == "__main__":
    main()
