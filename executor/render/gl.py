"""The renderer in OpenGL, without a window: on the GPU where there is one, else in software."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from executor.render import geometry, shaders
from executor.render.instances import GAMMA, Group, Instances
from executor.render.interface import GROUND, NOTHING, RenderError, Viewpoint

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from executor.messages import Scene

SAMPLES: Final = 4
SHADOW_SIZE: Final = 1024
SHADOW_REACH_M: Final = 14.0
INSTANCE_BYTES: Final = 96
SKY_PIECES: Final = 12


@dataclass(frozen=True)
class _Batch:
    """One draw call for each of picture, shadow and measurement."""

    shown: Any
    shadow: Any
    measured: Any
    rows: Any
    group: Group


class GlRenderer:
    """Draws with shadows of the first light and antialiasing.

    Raises:
        RenderError: there is no EGL, or it is older than OpenGL 3.3.
    """

    def __init__(self, samples: int = SAMPLES) -> None:
        self._context = _make_context()
        self.name = f"moderngl on {self._context.info['GL_RENDERER']}"
        self._samples = min(samples, int(self._context.max_samples))
        self._programs = self._compile()
        self._ground = self._vertex_array("ground", geometry.square())
        self._measured_ground = self._vertex_array("measure_ground", geometry.square())
        self._programs["measure_ground"]["ground"].value = GROUND
        self._measure_targets: dict[tuple[int, int], Any] = {}
        self._sky = self._vertex_array("sky", geometry.grid(SKY_PIECES))
        self._shadow_map, self._shadow_target = self._make_shadow()
        self._targets: dict[tuple[int, int, bool], tuple[Any, Any]] = {}
        self._batches: list[_Batch] = []
        self._buffers: list[Any] = []
        self._instances: Instances | None = None
        self._drawn_poses: NDArray[np.float32] | None = None

    def load(self, scene: Scene) -> None:
        """Takes a scene in place of the last one."""
        self._release_scene()
        self._instances = Instances(scene)
        for group in self._instances.groups:
            points, order = geometry.indexed(group.vertices)
            vertices, indices = self._context.buffer(points.tobytes()), self._context.buffer(order.tobytes())
            rows = self._context.buffer(reserve=group.count * INSTANCE_BYTES, dynamic=True)
            self._buffers += [vertices, indices, rows]
            self._batches.append(self._batch(vertices, indices, rows, group))
        self._set_light(scene)

    def draw(
        self, poses: NDArray[np.float32], view: Viewpoint, width: int, height: int, *, smooth: bool = True
    ) -> NDArray[np.uint8]:
        """Returns the picture as height × width × 3 bytes of RGB, the top row first."""
        self._place(poses)
        shown, resolved = self._target(width, height, smooth=smooth)
        # Upside down, so that the rows come out of the buffer from top to bottom.
        projection = np.diag([1.0, -1.0, 1.0, 1.0]) @ view.projection_matrix(width, height)
        matrix = view.view_matrix()
        self._cast_shadow(view)
        shown.use()
        shown.clear(depth=1.0)
        self._paint(projection @ matrix, view)
        if resolved is not shown:
            self._context.copy_framebuffer(resolved, shown)
        picture = np.empty((height, width, 3), np.uint8)
        resolved.read_into(picture, components=3, alignment=1)
        return picture

    def depth(
        self, poses: NDArray[np.float32], view: Viewpoint, width: int, height: int
    ) -> NDArray[np.float32]:
        """Returns how far ahead everything is, in m along the optical axis; +inf for nothing."""
        return np.ascontiguousarray(self._measure(poses, view, width, height)[:, :, 0])

    def segmentation(
        self, poses: NDArray[np.float32], view: Viewpoint, width: int, height: int
    ) -> NDArray[np.int32]:
        """Returns for each pixel the row of the object in the scene, `GROUND` or `NOTHING`."""
        return self._measure(poses, view, width, height)[:, :, 1].astype(np.int32)

    def close(self) -> None:
        """Frees the context and all that was made in it."""
        if self._context is not None:
            self._context.release()
            self._context = None

    # --- inside ---

    def _compile(self) -> dict[str, Any]:
        sources = {
            "shadow": (shaders.SHADOW_VERTEX, shaders.SHADOW_FRAGMENT),
            "object": (shaders.OBJECT_VERTEX, shaders.OBJECT_FRAGMENT),
            "ground": (shaders.GROUND_VERTEX, shaders.GROUND_FRAGMENT),
            "measure": (shaders.MEASURE_VERTEX, shaders.MEASURE_FRAGMENT),
            "measure_ground": (shaders.MEASURE_GROUND_VERTEX, shaders.MEASURE_FRAGMENT),
            "sky": (shaders.SKY_VERTEX, shaders.SKY_FRAGMENT),
        }
        return {
            name: self._context.program(vertex_shader=vertex, fragment_shader=fragment)
            for name, (vertex, fragment) in sources.items()
        }

    def _vertex_array(self, program: str, vertices: NDArray[np.float32]) -> Any:
        buffer = self._context.buffer(vertices.tobytes())
        return self._context.vertex_array(self._programs[program], [(buffer, "3f 3x4", "in_position")])

    def _batch(self, vertices: Any, indices: Any, rows: Any, group: Group) -> _Batch:
        shown = [
            (vertices, "3f 3f", "in_position", "in_normal"),
            (rows, "16f 4f 4x4/i", "in_model", "in_color"),
        ]
        measured = [(vertices, "3f 3x4", "in_position"), (rows, "16f 4x4 1f 3x4/i", "in_model", "in_row")]
        shadow = [(vertices, "3f 3x4", "in_position"), (rows, "16f 8x4/i", "in_model")]
        return _Batch(
            self._context.vertex_array(self._programs["object"], shown, indices),
            self._context.vertex_array(self._programs["shadow"], shadow, indices),
            self._context.vertex_array(self._programs["measure"], measured, indices),
            rows,
            group,
        )

    def _make_shadow(self) -> tuple[Any, Any]:
        depth = self._context.depth_texture((SHADOW_SIZE, SHADOW_SIZE))
        depth.compare_func = "<="
        depth.repeat_x = depth.repeat_y = False
        return depth, self._context.framebuffer(depth_attachment=depth)

    def _target(self, width: int, height: int, *, smooth: bool) -> tuple[Any, Any]:
        """Returns the framebuffer to draw into and the one to read from."""
        key = (width, height, smooth and self._samples > 1)
        if key not in self._targets:
            size = (width, height)
            resolved = self._framebuffer(size, 0)
            self._targets[key] = (self._framebuffer(size, self._samples) if key[2] else resolved, resolved)
        return self._targets[key]

    def _framebuffer(self, size: tuple[int, int], samples: int) -> Any:
        color = self._context.renderbuffer(size, 4, samples=samples)
        depth = self._context.depth_renderbuffer(size, samples=samples)
        return self._context.framebuffer([color], depth)

    def _set_light(self, scene: Scene) -> None:
        light = scene.lights[0]
        direction = np.array(light.direction) / np.linalg.norm(light.direction)
        self._sun = direction
        for name in ("object", "ground"):
            program = self._programs[name]
            program["sun_direction"].value = tuple(direction)
            program["sun_color"].value = tuple(light.intensity * np.array([0.78, 0.74, 0.68]))
        self._programs["ground"]["ground_color"].value = tuple(np.array(scene.ground_color[:3]) ** GAMMA)

    def _place(self, poses: NDArray[np.float32]) -> None:
        if self._instances is None:
            raise RuntimeError("load a scene first")
        if len(self._instances) and poses is not self._drawn_poses:
            rows = self._instances.update(poses)
            for batch in self._batches:
                first = batch.group.first
                batch.rows.write(rows[first : first + batch.group.count].tobytes())
            self._drawn_poses = poses

    def _cast_shadow(self, view: Viewpoint) -> None:
        matrix = _light_matrix(self._sun, view)
        for name in ("shadow", "object", "ground"):
            self._programs[name]["light"].write(_bytes(matrix))
        self._shadow_target.use()
        self._shadow_target.clear(depth=1.0)
        self._context.enable_only(self._context.DEPTH_TEST)
        for batch in self._batches:
            batch.shadow.render(instances=batch.group.count)

    def _measure(
        self, poses: NDArray[np.float32], view: Viewpoint, width: int, height: int
    ) -> NDArray[np.float32]:
        self._place(poses)
        target = self._measure_targets.get((width, height))
        if target is None:
            values = self._context.renderbuffer((width, height), 2, dtype="f4")
            depth = self._context.depth_renderbuffer((width, height))
            target = self._measure_targets[width, height] = self._context.framebuffer([values], depth)
        target.use()
        target.clear(np.inf, NOTHING, depth=1.0)
        projection = np.diag([1.0, -1.0, 1.0, 1.0]) @ view.projection_matrix(width, height)
        for name in ("measure", "measure_ground"):
            self._programs[name]["view_projection"].write(_bytes(projection @ view.view_matrix()))
        self._programs["measure_ground"]["eye"].value = view.eye
        self._context.enable_only(self._context.DEPTH_TEST | self._context.CULL_FACE)
        self._context.front_face = "cw"
        for batch in self._batches:
            batch.measured.render(instances=batch.group.count)
        self._context.enable_only(self._context.DEPTH_TEST)
        self._measured_ground.render()
        measured = np.empty((height, width, 2), np.float32)
        target.read_into(measured, components=2, dtype="f4")
        return measured

    def _paint(self, matrix: NDArray[np.float64], view: Viewpoint) -> None:
        programs, context = self._programs, self._context
        self._shadow_map.use(0)
        for name in ("object", "ground"):
            programs[name]["view_projection"].write(_bytes(matrix))
        programs["ground"]["eye"].value = view.eye
        context.enable_only(context.DEPTH_TEST | context.CULL_FACE)
        context.front_face = "cw"  # the picture is upside down
        for batch in self._batches:
            batch.shown.render(instances=batch.group.count)
        context.enable_only(context.DEPTH_TEST)
        self._ground.render()
        turn = matrix @ _translation(view.eye)
        programs["sky"]["to_world"].write(_bytes(np.linalg.inv(turn)))
        context.depth_func = "<="
        self._sky.render()
        context.depth_func = "<"

    def _release_scene(self) -> None:
        for batch in self._batches:
            batch.shown.release()
            batch.shadow.release()
            batch.measured.release()
        for buffer in self._buffers:
            buffer.release()
        self._batches, self._buffers, self._drawn_poses = [], [], None


def _make_context() -> Any:
    try:
        import moderngl  # noqa: PLC0415 - needs libEGL, which may be missing

        options: dict[str, Any] = {"standalone": True, "require": 330, "backend": "egl"}
        return moderngl.create_context(**options)
    except Exception as error:
        raise RenderError(str(error).splitlines()[0] if str(error) else type(error).__name__) from error


def _light_matrix(sun: NDArray[np.float64], view: Viewpoint) -> NDArray[np.float64]:
    """Returns the transform to the light's clip space: a box round what is ahead of the viewer."""
    reach = SHADOW_REACH_M
    center = np.array(view.eye) + np.array(view.ahead) * reach * 0.6
    center[2] = 0.0
    texel = 2 * reach / SHADOW_SIZE
    # In whole texels, so that shadows' edges do not swim when the viewer moves.
    center[:2] = np.round(center[:2] / (texel * 8)) * texel * 8
    side = np.cross(sun, [0.0, 0.0, 1.0])
    if np.linalg.norm(side) < 1e-6:
        side = np.array([1.0, 0.0, 0.0])
    side /= np.linalg.norm(side)
    rotation = np.array([side, np.cross(side, sun), -sun])
    matrix = np.eye(4)
    matrix[:3, :3] = rotation
    matrix[:3, 3] = -rotation @ center
    return np.diag([1 / reach, 1 / reach, -1 / (2 * reach), 1.0]) @ matrix


def _translation(by: tuple[float, float, float]) -> NDArray[np.float64]:
    matrix = np.eye(4)
    matrix[:3, 3] = by
    return matrix


def _bytes(matrix: NDArray[np.floating[Any]]) -> bytes:
    return matrix.T.astype(np.float32).tobytes()
