"""Runs random applications in lock-step and records them: `… truth_run FOLDER MOMENTS SEED…`.

For each seed it writes `SEED.mcap`, what the observer in the application saw (`SEED.notes`), and where all
objects were at the moments (`SEED.poses`), from the world itself.
"""

from __future__ import annotations

import json
import random
import sys
from bisect import bisect_left
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from executor.headless.lockstep import LockstepOptions, run_lockstep
from tests.executor.recorder.truth_app import random_app

if TYPE_CHECKING:
    from executor.world.physics.bullet import BulletWorld


def main() -> None:
    folder, count = Path(sys.argv[1]), int(sys.argv[2])
    for seed in map(int, sys.argv[3:]):
        run(folder, seed, count)
        for name in ("Act", "TruthObserver"):  # the next application has its own
            sys.modules.pop(name, None)


def run(folder: Path, seed: int, count: int) -> None:
    chance = random.Random(seed)  # noqa: S311 - a reproducible run, no secret
    duration_s = chance.uniform(2.0, 12.0)
    worlds: list[BulletWorld] = []
    places: list[tuple[float, Any]] = []
    ticked_s = [0.0]

    def look() -> None:
        if worlds:
            places.append((worlds[0].time_s, worlds[0].poses().copy()))

    def watch(world: BulletWorld, _tree: Any) -> None:
        if not worlds:
            worlds.append(world)
            look()
        ticked_s[0] = world.time_s

    options = LockstepOptions(
        duration_s=duration_s,
        seed=seed,
        on_finish="repeat",
        on_error="failure" if seed % 3 else "stop",
        recording=folder / f"{seed}.mcap",
    )
    run_lockstep(random_app(seed, folder / f"{seed}.notes"), options, watch=watch, moved=look)
    # At the end the tree is halted, when the application's clock stands already.
    moments = sorted(chance.uniform(0.0, ticked_s[0]) for _ in range(count))
    found = [[t, between(places, t)] for t in moments]
    (folder / f"{seed}.poses").write_text(json.dumps(found), encoding="utf-8")


def between(places: list[tuple[float, Any]], t: float) -> list[list[float]]:
    """Returns the poses at a time, between those of the steps around it."""
    at = min(bisect_left(places, t, key=lambda each: each[0]), len(places) - 1)
    (t0, first), (t1, second) = places[max(at - 1, 0)], places[at]
    share = 0.0 if t1 == t0 else (t - t0) / (t1 - t0)
    turned = np.where((first[:, 3:] * second[:, 3:]).sum(axis=1, keepdims=True) < 0, -1.0, 1.0)
    second = np.concatenate([second[:, :3], second[:, 3:] * turned], axis=1)
    found = first + (second - first) * share
    found[:, 3:] /= np.linalg.norm(found[:, 3:], axis=1, keepdims=True)
    poses: list[list[float]] = np.round(found, 5).tolist()
    return poses


if __name__ == "__main__":
    main()
