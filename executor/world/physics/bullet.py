"""The world in PyBullet: fixed steps of 1/240 s, control of robots and actors at 60 Hz."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

from executor.messages import Light, Mesh, Scene, SensorPlacement
from executor.robots.config import RobotConfig, load_robot
from executor.world.engine import Bullet
from executor.world.geometry.kinematics import mesh_key
from executor.world.geometry.objects import Kind, SceneObjects, Where
from executor.world.geometry.transforms import Pose, compose, from_xyz_rpy
from executor.world.interface import WorldError
from executor.world.physics import ceiling
from executor.world.physics.actor import BulletActor
from executor.world.physics.assembly import Assembly, Links, read_assembly
from executor.world.physics.bodies import Body, make_body, make_ground, model_mesh, rgba, scene_shapes
from executor.world.physics.ceiling import ceiling_of, upper_part
from executor.world.physics.dump import (
    DUMP_VERSION,
    dump_state,
    load_state,
    restore_physics,
    save_physics,
)
from executor.world.physics.paint import texture_key, textures_of
from executor.world.physics.placement import put_at_rest
from executor.world.physics.randomize import draw
from executor.world.physics.robot import BulletRobot
from executor.world.sensing.rays import RayCaster

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    import numpy as np
    from numpy.typing import NDArray

    from executor.universes.model import Model, Universe
    from executor.world.geometry.mesh_colors import Rgba
    from executor.world.physics.collision import Collision

STEP_HZ: Final = 240
CONTROL_EVERY: Final = 4  # steps
GRAVITY: Final = 9.81
RESIDUAL: Final = 1e-6
"""Residual at which the solver stops.

After a drive of 8 m, the result differs by less than 3 mm from that of 300 iterations.
"""


@dataclass(frozen=True)
class _Saved:
    physics: int
    steps: int
    robots: list[dict[str, Any]]
    actors: list[list[float]]


@dataclass
class _Content:
    """The content of the world that a reset creates again."""

    ground: int = -1
    bodies: dict[str, Body] = field(default_factory=dict)
    objects: dict[str, int] = field(default_factory=dict)
    assemblies: dict[str, Assembly] = field(default_factory=dict)
    robots: list[BulletRobot] = field(default_factory=list)
    actors: list[BulletActor] = field(default_factory=list)
    names: dict[int, str] = field(default_factory=dict)
    movers: set[int] = field(default_factory=set)


class BulletWorld:
    """A world in PyBullet.

    Args:
        universe: the document.
        seed: the seed of the universe's random values and of the sensors' noise.
        robot: the id of a robot that replaces the one of the universe.
        assets: the folder with the project's robots and meshes.
        configs: the configuration of each robot, where they are known already.

    Attributes:
        on_collision: called at the start of each collision, with the robot; `take_collisions` returns it too.

    Raises:
        RobotError: a robot of the universe does not exist or is invalid.
    """

    step_s: Final = 1.0 / STEP_HZ

    def __init__(
        self,
        universe: Universe,
        *,
        seed: int = 0,
        robot: str | None = None,
        assets: Path | None = None,
        configs: Sequence[RobotConfig] | None = None,
    ) -> None:
        self.on_collision: Callable[[str, Collision], None] | None = None
        self._universe = draw(universe, seed)
        self._seed = seed
        self._configs: list[RobotConfig] = (
            [load_robot(robot or place.model, assets) for place in universe.robots]
            if configs is None
            else list(configs)
        )
        self._assemblies = {
            model.file: read_assembly(model, assets) for model in self._universe.models if model.is_assembly
        }
        self._meshes, self._parts = _meshes(self._configs, self._assemblies, self._universe, assets)
        self._textures = textures_of(self._universe, assets)
        self._bullet = Bullet()
        self._steps = 0
        self._poses: NDArray[np.float32] | None = None
        self._collisions: list[tuple[str, Collision]] = []
        self._objects = SceneObjects()
        self._placed: dict[str, list[float]] = {}
        self._content = _Content()
        self._build()

    @property
    def name(self) -> str:
        """The universe's name."""
        return self._universe.name

    @property
    def universe(self) -> Universe:
        """The universe, with its random values drawn."""
        return self._universe

    @property
    def has_drawn(self) -> bool:
        """Whether results may depend on the seed.

        They may if the universe has random values, or if noise of a robot is configured; IMU noise counts
        once the IMU was read.
        """
        return bool(self._universe.random) or any(robot.has_drawn for robot in self.robots)

    @property
    def time_s(self) -> float:
        """Simulated time in s since the last reset."""
        return self._steps / STEP_HZ

    @property
    def scene(self) -> Scene:
        """The scene, with current poses."""
        self._objects.tell(self.poses())
        self._scene.t = self.time_s
        return self._scene

    @property
    def robots(self) -> Sequence[BulletRobot]:
        """The robots, in the universe's order."""
        return self._content.robots

    @property
    def actors(self) -> Sequence[BulletActor]:
        """The people, in the universe's order."""
        return self._content.actors

    @property
    def bullet(self) -> Bullet:
        """The physics server, for questions about distances."""
        return self._bullet

    def solids(self) -> dict[str, tuple[int, ...]]:
        """Returns the bodies of each thing that robots can touch, without the ground."""
        content = self._content
        solid = {model.id for model in self._universe.models if model.solid}
        found: dict[str, tuple[int, ...]] = {
            id_: (body.uid,) for id_, body in content.bodies.items() if id_ in solid
        }
        found |= {id_: (made.uid,) for id_, made in content.assemblies.items()}
        found |= {actor.id: tuple(actor.uids) for actor in content.actors}
        return found | {robot.id: (robot.uid,) for robot in content.robots}

    def step(self, count: int = 1) -> None:
        """Simulates `count` steps of 1/240 s."""
        bullet, robots = self._bullet, self._content.robots
        names, movers = self._content.names, self._content.movers
        for _ in range(count):
            if self._steps % CONTROL_EVERY == 0:
                self._control()
            bullet.stepSimulation()
            self._steps += 1
            now_s = self.time_s
            for robot in robots:
                for collision in robot.observe_contact(now_s, names, movers):
                    self._collisions.append((robot.id, collision))
                    if self.on_collision is not None:
                        self.on_collision(robot.id, collision)
            if self._steps % CONTROL_EVERY == 0:
                for robot in robots:
                    robot.measure(now_s, CONTROL_EVERY / STEP_HZ)
        self._poses = None

    def reseed(self, seed: int) -> None:
        """Draws all noise from another seed from now on; what the universe drew stays.

        The seed of the world itself changes nothing: its noise continues.
        """
        if seed == self._seed:
            return
        self._seed = seed
        for robot in self._content.robots:
            robot.reseed(seed)

    def reset(self) -> None:
        """Restores the initial state."""
        self._bullet.resetSimulation()
        self._build()

    def save(self) -> _Saved:
        """Returns the full state."""
        content = self._content
        return _Saved(
            self._bullet.saveState(),
            self._steps,
            [robot.save() for robot in content.robots],
            [actor.save() for actor in content.actors],
        )

    def restore(self, state: _Saved) -> None:
        """Restores a saved state."""
        self._bullet.restoreState(state.physics)
        self._restore_rest(state.steps, state.robots, state.actors)

    def forget(self, state: _Saved) -> None:
        """Frees the memory of a saved state."""
        self._bullet.removeState(state.physics)

    def dump(self) -> bytes:
        """Returns the full state as plain data, for `load` in another process."""
        content = self._content
        return dump_state(
            {
                "version": DUMP_VERSION,
                "universe": self.name,
                "steps": self._steps,
                "placed": self._placed,
                "robots": {robot.id: robot.save() for robot in content.robots},
                "actors": {actor.id: actor.save() for actor in content.actors},
                "physics": save_physics(self._bullet),
            }
        )

    def load(self, data: bytes) -> None:
        """Restores a state that `dump` returned, of a world of the same universe, robots and seed.

        Raises:
            WorldError: the data are not such a state.
        """
        content = self._content
        state = load_state(
            data, self.name, [robot.id for robot in content.robots], [actor.id for actor in content.actors]
        )
        # Bullet restores contacts of the pairs that it knows, and a world that was never stepped knows none.
        self._bullet.performCollisionDetection()
        for body in self._placed.keys() - state["placed"].keys():
            self.move_body(body, next(m.pose for m in self._universe.models if m.id == body))
        for body, pose in state["placed"].items():
            self.move_body(body, pose)
        restore_physics(self._bullet, state["physics"])
        self._placed = state["placed"]
        self._restore_rest(state["steps"], list(state["robots"].values()), list(state["actors"].values()))

    def poses(self) -> NDArray[np.float32]:
        """Returns the poses of the scene's objects; they are computed at most once in each step."""
        if self._poses is None:
            self._poses = self._objects.update()
        return self._poses

    def read_poses(self) -> Callable[[], NDArray[np.float32]]:
        """Returns a function that computes the present poses at any later time."""
        if (poses := self._poses) is not None:
            return lambda: poses
        return self._objects.read()

    def move_body(self, body: str, pose: Sequence[float]) -> None:
        """Moves a model or a robot to the pose [x, y, z, roll, pitch, yaw]."""
        wanted = from_xyz_rpy(pose)
        for robot in self._content.robots:
            if robot.id == body:
                put_at_rest(self._bullet, robot.uid, compose(wanted, self._inertial_of(robot.uid)))
                robot.moved_by_hand()
                break
        else:
            if body in self._content.assemblies:
                self._content.assemblies[body].move_body(wanted, self._objects)
            elif body in self._content.bodies:
                put_at_rest(self._bullet, self._content.bodies[body].uid, wanted)
                self._objects.place(self._content.objects[body], wanted)
                self._rays.moved()
            else:
                raise WorldError(f"there is no body {body!r} that can be moved")
            self._placed[body] = list(pose)
        self._poses = None

    def scale_lights(self, factor: float) -> None:
        """Multiplies the intensity of all lights; pictures change once the scene is loaded again."""
        lights = self._universe.lights
        self._scene.lights = [Light(list(light.direction), light.intensity * factor) for light in lights]

    def take_collisions(self) -> list[tuple[str, Collision]]:
        """Returns the collisions since the last call."""
        taken, self._collisions = self._collisions, []
        return taken

    def close(self) -> None:
        """Frees the physics server."""
        self._bullet.close()

    def _restore_rest(self, steps: int, robots: Sequence[Any], actors: Sequence[Any]) -> None:
        """Restores the state that the physics server does not hold."""
        self._steps = steps
        for robot, saved in zip(self._content.robots, robots, strict=True):
            robot.restore(saved, self.time_s)
        for actor, gait in zip(self._content.actors, actors, strict=True):
            actor.restore(gait)
        self._rays.moved()
        self._poses = None
        self._collisions.clear()

    def _control(self) -> None:
        now_s, dt_s = self.time_s, CONTROL_EVERY / STEP_HZ
        actors = self._content.actors
        robots = [robot.footprint for robot in self.robots] if any(actor.yields for actor in actors) else []
        for actor in actors:
            actor.advance(dt_s, robots)
        for robot in self._content.robots:
            robot.control(now_s, dt_s)

    def _inertial_of(self, uid: int) -> Pose:
        info = self._bullet.getDynamicsInfo(uid, -1)
        return (*info[3], *info[4])

    def _build(self) -> None:
        self._set_up_physics()
        self._steps = 0
        self._poses, self._collisions = None, []
        self._placed = {}
        self._objects, self._content = SceneObjects(), _Content()
        universe, content = self._universe, self._content
        content.ground = make_ground(self._bullet, universe.ground.friction)
        self._rays = RayCaster(self._bullet)
        for model in universe.models:
            if model.is_assembly:
                self._add_assembly(model)
            else:
                self._add_model(model)
        overhead = ceiling_of(universe)
        if overhead is not None:
            shape, pose = overhead
            self._objects.add(ceiling.NAME, "", "static", [shape], pose)
        content.actors = [BulletActor(self._bullet, actor) for actor in universe.actors]
        content.robots = [
            BulletRobot(self._bullet, self._rays, config, place, index=i, seed=self._seed)
            for i, (config, place) in enumerate(zip(self._configs, universe.robots, strict=True))
        ]
        content.names.update({uid: actor.id for actor in content.actors for uid in actor.uids})
        content.names.update({robot.uid: robot.id for robot in content.robots})
        walking = [*(uid for actor in content.actors for uid in actor.uids), *(r.uid for r in content.robots)]
        for uid in walking:
            self._rays.add_body(uid)
        content.movers.update(walking)
        self._scene = self._make_scene()

    def _set_up_physics(self) -> None:
        bullet = self._bullet
        bullet.setGravity(0, 0, -GRAVITY)
        bullet.setPhysicsEngineParameter(
            fixedTimeStep=self.step_s,
            numSubSteps=0,
            numSolverIterations=30,
            solverResidualThreshold=RESIDUAL,
            deterministicOverlappingPairs=1,
        )

    def _add_model(self, model: Model) -> None:
        body = make_body(self._bullet, model, self._meshes.get(model.file))
        self._content.bodies[model.id] = body
        self._content.names[body.uid] = model.id
        kind: Kind = "dynamic" if body.is_dynamic else "static"
        parts = self._parts.get(model.file, ())
        shapes = [*scene_shapes(model, parts), *upper_part(model, self._universe)]
        object_id = self._objects.add(model.id, "", kind, shapes, from_xyz_rpy(model.pose))
        self._content.objects[model.id] = object_id
        if model.solid:
            self._show_to_rays(model, body)
        if body.is_dynamic:
            self._content.movers.add(body.uid)
            self._objects.add_mover(lambda: self._where(object_id, body.uid))

    def _show_to_rays(self, model: Model, body: Body) -> None:
        if model.shape == "box" and not body.is_dynamic:
            self._rays.add_still_box(body.uid, model.size)
        elif model.shape == "cylinder" and not body.is_dynamic:
            self._rays.add_still_cylinder(body.uid, model.size[0], model.size[1])
        else:
            self._rays.add_body(body.uid)

    def _add_assembly(self, model: Model) -> None:
        made = Assembly(self._bullet, model, self._assemblies[model.file])
        made.add_to_scene(self._objects)
        self._content.assemblies[model.id] = made
        self._content.names[made.uid] = model.id
        if made.is_dynamic:
            self._content.movers.add(made.uid)
        self._rays.add_body(made.uid)

    def _where(self, object_id: int, uid: int) -> Where:
        position, orientation = self._bullet.getBasePositionAndOrientation(uid)
        return lambda: [(object_id, (*position, *orientation))]

    def _make_scene(self) -> Scene:
        sensors: list[SensorPlacement] = []
        for actor in self._content.actors:
            actor.add_to_scene(self._objects)
        for robot in self._content.robots:
            robot.add_to_scene(self._objects, sensors)
        universe = self._universe
        shown = {shape.mesh for each in self._objects.objects for shape in each.shapes}
        return Scene(
            name=universe.name,
            t=0.0,
            objects=self._objects.objects,
            meshes={name: mesh for name, mesh in self._meshes.items() if name in shown},
            lights=[Light(list(light.direction), light.intensity) for light in universe.lights],
            ground_color=rgba(universe.ground.color),
            sensors=sensors,
            textures=self._textures,
            ground_texture=texture_key(universe.ground),
        )


def _meshes(
    configs: list[RobotConfig], assemblies: dict[str, Links], universe: Universe, assets: Path | None
) -> tuple[dict[str, Mesh], dict[str, list[tuple[Rgba | None, str]]]]:
    """Returns the meshes by their names in the scene, and the colours of models' meshes with theirs."""
    found = {mesh_key(config.id, name): mesh for config in configs for name, mesh in config.meshes.items()}
    for file, (_, meshes) in assemblies.items():
        found |= {mesh_key(file, name): mesh for name, mesh in meshes.items()}
    parts: dict[str, list[tuple[Rgba | None, str]]] = {}
    for model in universe.models:
        if model.shape != "mesh" or model.file in found:
            continue
        read = model_mesh(model, assets)
        found[model.file] = read.whole
        for number, (color, mesh) in enumerate(read.parts):
            found[f"{model.file}#{number}"] = mesh
            parts.setdefault(model.file, []).append((color, f"{model.file}#{number}"))
    return found, parts
