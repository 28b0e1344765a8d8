"""A world and a robot of others: what importing them costs beside trimesh, and the world beside `house`.

    python -m tests.benchmarks imported --world FILE [--robot FILE --workspace FOLDER]

The files are not ours, so they are named: the pages in `docs/` say which were measured.
"""

from __future__ import annotations

import argparse
import os
import statistics
import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

from executor.imports.worlds import import_sdf
from executor.robots.importing.bring import places_of
from executor.robots.links import read_links
from executor.robots.prepare import mesh_path
from executor.sdf.files import DiskFiles
from executor.universes import load_builtin, parse_universe
from executor.world.physics.bullet import BulletWorld
from tests.benchmarks.figures import Figure, show
from tests.benchmarks.timing import best_s
from tree_gardener.packages import Packages, Place, installed_places

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from executor.universes.model import Universe

ROUNDS = 5
SIMULATED_S = 10.0
HERTZ = 240


def measure(options: Sequence[str] = ()) -> Iterable[Figure]:
    """Yields the figures of the files that the options name."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--world", type=Path)
    parser.add_argument("--robot", type=Path)
    parser.add_argument("--workspace", type=Path)
    parser.add_argument("--at", type=float, nargs=2, default=[0.0, 0.0], help="where the robot stands, in m")
    asked = parser.parse_args(options)
    if asked.world:
        yield from world(asked.world, asked.at)
    if asked.robot:
        yield from robot(asked.robot, asked.workspace)


def main() -> None:
    """Prints the figures."""
    show(measure(sys.argv[1:]))


def by_trimesh(paths: Sequence[Path]) -> None:
    """Reads mesh files by trimesh alone."""
    import trimesh

    for path in paths:
        trimesh.load(path, process=False)


def _beside(what: str, ours_s: float, paths: Sequence[Path]) -> Iterable[Figure]:
    theirs_s = best_s(lambda: by_trimesh(paths))
    yield Figure(f"{what}: processor time", ours_s, "s")
    yield Figure(f"{what}: trimesh alone, {len(paths)} meshes", theirs_s, "s")
    yield Figure(f"{what}: ratio", ours_s / theirs_s, "×")


def world(file: Path, at: Sequence[float]) -> Iterable[Figure]:
    """Imports an SDF world, and drives in it and in `house`, in turn."""
    root = next((up for up in file.parents if (up / "package.xml").is_file()), file.parent)
    places = [Place("what is imported", root)]
    data = file.read_bytes()

    def imported() -> Any:
        files = DiskFiles(Packages(file.parent, places, installed_places(os.environ)))
        return import_sdf(data, str(file), files, name="world")

    made = imported()
    sources = {
        path.stat().st_size: path
        for path in root.rglob("*")
        if path.suffix.lower() in (".dae", ".stl", ".obj", ".glb", ".gltf")
    }
    meshes = [data for path, data in made.files.items() if not path.endswith(".urdf")]
    paths = [sources[len(each)] for each in meshes if len(each) in sources]
    yield from _beside(f"importing {file.name}, {made.things} things", best_s(imported), paths)
    with tempfile.TemporaryDirectory() as folder:
        for name, content in made.files.items():
            target = Path(folder, name)
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(content)
        yield from _driven(file.name, parse_universe(made.text), Path(folder), at)


def _driven(name: str, universe: Universe, assets: Path, at: Sequence[float]) -> Iterable[Figure]:
    house = load_builtin("house")
    spawned = house.robots[0]
    placed = spawned.model_copy(update={"pose": [*at, *spawned.pose[2:]]})
    began_s = time.process_time()
    ours = BulletWorld(house)
    between_s = time.process_time()
    theirs = BulletWorld(universe.model_copy(update={"robots": [placed]}), assets=assets)
    yield Figure("house: to load", between_s - began_s, "s")
    yield Figure(f"{name}: to load", time.process_time() - between_s, "s")
    factors: dict[str, list[float]] = {"house": [], name: []}
    for _ in range(ROUNDS):
        for title, each in (("house", ours), (name, theirs)):
            factors[title].append(SIMULATED_S / _drive_s(each))
    middle = {title: statistics.median(values) for title, values in factors.items()}
    for title, factor in middle.items():
        yield Figure(f"{title}: simulated time by processor time, with LIDAR", factor, "×", "higher")
    yield Figure(f"{name} beside house", middle[name] / middle["house"], "×", "higher")
    ours.close()
    theirs.close()


def _drive_s(world: BulletWorld) -> float:
    """Returns the processor time of some simulated seconds with the scans of all LIDARs."""
    robot = world.robots[0]
    robot.command(0.2, 0.5)
    steps = 0
    dues = {lidar.name: 0.0 for lidar in robot.config.lidars}
    began_s = time.process_time()
    while steps < SIMULATED_S * HERTZ:
        world.step(4)
        steps += 4
        for lidar in robot.config.lidars:
            if steps / HERTZ >= dues[lidar.name]:
                robot.scan(lidar)
                dues[lidar.name] += 1 / lidar.rate_hz
    return time.process_time() - began_s


def robot(file: Path, workspace: Path | None) -> Iterable[Figure]:
    """Reads a robot with its meshes."""
    places = places_of(file, file, workspace)
    urdf, _ = read_links(file, file.name, places)
    packages = Packages(file.parent, places, installed_places(os.environ))
    paths = [mesh_path(name, file.parent, packages) for name in urdf.mesh_files]
    ours_s = best_s(lambda: read_links(file, file.name, places))
    yield from _beside(f"reading {file.name}", ours_s, paths)


if __name__ == "__main__":
    main()
