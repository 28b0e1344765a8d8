"""The renderer in OpenGL, without a window: on the GPU if there is one, otherwise in software.

A scene is one buffer of triangles on the GPU; a picture is one draw call of the visible ones, from near to
far, so that hidden ones cost nothing. Poses are in a texture. Shadows are redrawn only where something moved.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import cv2
import numpy as np

from executor.render import geometry, programs, shadow
from executor.render.compiler import release_compiler
from executor.render.interface import GROUND, NOTHING, RenderError, Viewpoint
from executor.render.layers import SIDE, pixels
from executor.render.picture_cache import CachedPicture, PictureCache
from executor.render.pieces import VERTEX, Pieces, matrices
from executor.render.shadow import ShadowPlan
from executor.render.smoothing import smoothed
from executor.render.targets import Targets

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from executor.messages import Scene
    from executor.render.rectangles import Rectangle

SAMPLES: Final = 4
SETTLED: Final = 20
"""Number of pictures of a scene after which all its shaders are compiled."""
SKY_PIECES: Final = 8
GAMMA: Final = 2.0  # as in the shaders
SUN_COLOR: Final = (0.78, 0.74, 0.68)
GROUND_SKY: Final = (0.52, 0.55, 0.60)
SOFTWARE: Final = ("llvmpipe", "softpipe", "swrast")
UNITS: Final = {"matrices": 0, "shadow_map": 1, "pictures": 2}
"""Texture unit of each sampler, by the sampler's name."""


class GlRenderer:
    """Draws with shadows of the first light and antialiasing.

    Raises:
        RenderError: EGL is missing, or its OpenGL is older than 3.3.
    """

    def __init__(self) -> None:
        self._context = _make_context()
        card = str(self._context.info["GL_RENDERER"])
        self.name = f"moderngl on {card}"
        self._is_software = any(name in card.lower() for name in SOFTWARE)
        self._programs = programs.compile_all(self._context, gather=self._is_software)
        for program in self._programs.values():
            for name, unit in UNITS.items():
                if name in program:
                    program[name].value = unit
        self._programs["measure_ground"]["ground"].value = GROUND
        self._ground = self._shown_ground = self._quad("ground", geometry.square())
        self._measured_ground = self._quad("measure_ground", geometry.square())
        self._sky = self._quad("sky", geometry.grid(SKY_PIECES))
        self._shadow_map = self._context.depth_texture((shadow.SIZE, shadow.SIZE))
        self._shadow_map.compare_func = "<="
        self._shadow_map.repeat_x = self._shadow_map.repeat_y = False
        self._shadow_target = self._context.framebuffer(depth_attachment=self._shadow_map)
        samples = 1 if self._is_software else min(SAMPLES, int(self._context.max_samples))
        self._targets = Targets(self._context, samples)
        self._stock: _Stock | None = None
        self._pictures: Any = None
        self._textured_ground: Any = None
        self._plan: ShadowPlan | None = None
        self._cached = PictureCache()
        self._unsettled = 0
        self._sun = np.array([0.0, 0.0, -1.0])
        self._drawn_poses: NDArray[np.float32] | None = None
        self._placed = np.empty((0, 3, 4), np.float32)

    def load(self, scene: Scene) -> None:
        """Replaces the scene."""
        if self._stock is not None:
            self._stock.release()
        if scene.textures:
            self._prepare_textures()
        self._stock = _Stock(self._context, self._programs, scene)
        self._hang_pictures(scene, self._stock.pieces.layers)
        self._plan, self._drawn_poses = None, None
        self._cached.clear()
        self._unsettled = SETTLED
        self._set_light(scene)

    def draw(
        self, poses: NDArray[np.float32], view: Viewpoint, width: int, height: int, *, smooth: bool = True
    ) -> NDArray[np.uint8]:
        """Returns the picture as height × width × 3 bytes of RGB, the top row first."""
        stock = self._place(poses)
        self._cast_shadow(stock, view)
        picture = self._whole(stock, view, width, height, smooth=smooth)
        return _finished(picture) if smooth and self._is_software else _rgb(picture)

    def redraw(
        self, poses: NDArray[np.float32], view: Viewpoint, width: int, height: int
    ) -> NDArray[np.uint8]:
        """Returns the same as `draw`, but draws only the changes of a known view.

        If nothing has changed, it returns the same array as before. Do not write into it.
        """
        if not self._is_software:
            return self.draw(poses, view, width, height)
        stock, key = self._place(poses), (view, width, height)
        plan = self._cast_shadow(stock, view)
        kept = self._cached.find(key)
        parts = None if kept is None else kept.outdated(stock.pieces, self._placed, plan, key)
        if kept is None or parts is None:
            raw = self._whole(stock, view, width, height, smooth=True)
            kept = CachedPicture(raw, _finished(raw.copy()), self._placed.copy(), plan.matrix.copy())
            self._cached.keep(key, kept)
        elif parts:
            self._draw_parts(stock, key, parts, kept.raw)
            kept.finished = _finished(kept.raw.copy())
        return kept.finished

    def depth(
        self, poses: NDArray[np.float32], view: Viewpoint, width: int, height: int
    ) -> NDArray[np.float32]:
        """Returns the depth in m along the optical axis; +inf for the background."""
        return np.ascontiguousarray(self._measure(poses, view, width, height)[:, :, 0])

    def segmentation(
        self, poses: NDArray[np.float32], view: Viewpoint, width: int, height: int
    ) -> NDArray[np.int32]:
        """Returns for each pixel the row of the object in the scene, `GROUND` or `NOTHING`."""
        return self._measure(poses, view, width, height)[:, :, 1].astype(np.int32)

    def close(self) -> None:
        """Frees the context and everything in it."""
        if self._context is not None:
            self._context.release()
            self._context = None

    def _quad(self, program: str, vertices: NDArray[np.float32]) -> Any:
        points, order = geometry.indexed(vertices)
        buffer, indices = self._context.buffer(points[:, :3].tobytes()), self._context.buffer(order.tobytes())
        return self._context.vertex_array(self._programs[program], [(buffer, "3f", "in_position")], indices)

    def _prepare_textures(self) -> None:
        """Compiles the programs of scenes with textures, once."""
        if "object_textured" in self._programs:
            return
        self._programs |= programs.compile_all(
            self._context, gather=self._is_software, sources=programs.TEXTURED
        )
        for name in programs.TEXTURED:
            program = self._programs[name]
            for uniform, unit in UNITS.items():
                if uniform in program:
                    program[uniform].value = unit
        self._textured_ground = self._quad("ground_textured", geometry.square())

    def _hang_pictures(self, scene: Scene, layers: dict[str, int]) -> None:
        """Uploads the scene's textures, as layers of one texture."""
        if self._pictures is not None:
            self._pictures.release()
            self._pictures = None
        self._shown_ground = self._ground
        if not layers:
            return
        context = self._context
        data = b"".join(pixels(scene.textures[name]).tobytes() for name in layers)
        self._pictures = context.texture_array((SIDE, SIDE, len(layers)), 3, data)
        self._pictures.build_mipmaps()
        # Interpolation between mipmaps would double the look-ups of a CPU.
        between = context.LINEAR_MIPMAP_NEAREST if self._is_software else context.LINEAR_MIPMAP_LINEAR
        self._pictures.filter = (between, context.LINEAR)
        if not self._is_software:
            self._pictures.anisotropy = 8.0
        if scene.ground_texture:
            self._shown_ground = self._textured_ground
            ground = self._programs["ground_textured"]
            ground["tile"].value = tuple(scene.textures[scene.ground_texture].tile)
            ground["layer"].value = float(layers[scene.ground_texture])

    def _lit(self, kind: str) -> list[Any]:
        """Returns the programs that draw objects or the ground, with and without textures."""
        return [self._programs[name] for name in (kind, f"{kind}_textured") if name in self._programs]

    def _set_light(self, scene: Scene) -> None:
        light = scene.lights[0]
        self._sun = np.array(light.direction) / np.linalg.norm(light.direction)
        color = light.intensity * np.array(SUN_COLOR)
        for program in self._lit("object"):
            program["sun_direction"].value = tuple(self._sun)
            program["sun_color"].value = tuple(color)
        base = np.array(scene.ground_color[:3]) ** GAMMA
        dark = base * GROUND_SKY
        for program in self._lit("ground"):
            program["dark"].value = tuple(dark)
            program["bright"].value = tuple(dark + base * color * max(-self._sun[2], 0.0))

    def _settle(self) -> None:
        """Releases the shader compiler after its work, since it is as large as the rest of the renderer."""
        if self._unsettled and self._is_software:
            self._unsettled -= 1
            if not self._unsettled:
                release_compiler()

    def _place(self, poses: NDArray[np.float32]) -> _Stock:
        if self._stock is None:
            raise RuntimeError("load a scene first")
        if poses is not self._drawn_poses:
            self._placed = matrices(poses)
            self._stock.place(self._placed)
            self._drawn_poses = poses
        self._settle()
        self._stock.matrices.use(UNITS["matrices"])
        return self._stock

    def _whole(
        self, stock: _Stock, view: Viewpoint, width: int, height: int, *, smooth: bool
    ) -> NDArray[np.uint8]:
        """Draws a picture as rows of RGBA."""
        shown = self._targets.picture(width, height, smooth=smooth)
        shown.use()
        self._context.clear(depth=1.0)
        orders = stock.pieces.seen_apart(self._placed, view, width, height)
        self._paint(stock, orders, _upside_down(view, width, height), view)
        return self._targets.read(width, height)

    def _draw_parts(
        self, stock: _Stock, key: tuple[Viewpoint, int, int], parts: list[Rectangle], into: NDArray[np.uint8]
    ) -> None:
        """Redraws parts of a picture."""
        view, width, height = key
        target, matrix = self._targets.picture(width, height, smooth=False), _upside_down(view, width, height)
        for part in parts:
            target.scissor = part
            target.use()
            target.clear(depth=1.0, viewport=part)
            self._paint(stock, stock.pieces.seen_apart(self._placed, view, width, height, part), matrix, view)
        target.scissor = None
        for part in parts:
            x, y, wide, high = part
            into[y : y + high, x : x + wide] = self._targets.read(wide, high, of=(width, height), at=(x, y))

    def _cast_shadow(self, stock: _Stock, view: Viewpoint) -> ShadowPlan:
        plan = self._plan = self._plan or ShadowPlan(stock.pieces, self._placed, self._sun)
        work = plan.dirty(self._placed, view)
        if not work:
            return plan
        matrix = _bytes(plan.matrix)
        for program in (self._programs["shadow"], *self._lit("object"), *self._lit("ground")):
            program["light"].write(matrix)
        target = self._shadow_target
        for rectangle, order in work:
            target.scissor = rectangle
            target.use()
            target.clear(depth=1.0, viewport=rectangle)
            self._context.enable_only(self._context.DEPTH_TEST)
            stock.shadow.render(vertices=stock.choose(order))
        target.scissor = None
        return plan

    def _paint(
        self,
        stock: _Stock,
        orders: tuple[NDArray[np.uint32], NDArray[np.uint32]],
        matrix: NDArray[np.float64],
        view: Viewpoint,
    ) -> None:
        context = self._context
        self._shadow_map.use(UNITS["shadow_map"])
        if self._pictures is not None:
            self._pictures.use(UNITS["pictures"])
        for program in (*self._lit("object"), *self._lit("ground")):
            program["view_projection"].write(_bytes(matrix))
        for program in self._lit("ground"):
            program["eye"].value = view.eye
        context.enable_only(context.DEPTH_TEST | context.CULL_FACE)
        context.front_face = "cw"  # the picture is upside down
        for array, order in zip((stock.shown, stock.textured), orders, strict=True):
            if len(order):
                array.render(vertices=stock.choose(order))
        context.enable_only(context.DEPTH_TEST)
        self._shown_ground.render()
        turn = matrix @ _translation(view.eye)
        self._programs["sky"]["to_world"].write(_bytes(np.linalg.inv(turn)))
        context.depth_func = "<="
        self._sky.render()
        context.depth_func = "<"

    def _measure(
        self, poses: NDArray[np.float32], view: Viewpoint, width: int, height: int
    ) -> NDArray[np.float32]:
        """Returns, for each pixel, the depth and the row of the object in the scene."""
        stock, context = self._place(poses), self._context
        target = self._targets.measured(width, height)
        target.use()
        target.clear(np.inf, NOTHING, depth=1.0)
        matrix = _bytes(_upside_down(view, width, height))
        for name in ("measure", "measure_ground"):
            self._programs[name]["view_projection"].write(matrix)
        self._programs["measure_ground"]["eye"].value = view.eye
        context.enable_only(context.DEPTH_TEST | context.CULL_FACE)
        context.front_face = "cw"
        count = stock.choose(stock.pieces.seen(self._placed, view, width, height))
        if count:
            stock.measured.render(vertices=count)
        context.enable_only(context.DEPTH_TEST)
        self._measured_ground.render()
        measured = np.empty((height, width, 2), np.float32)
        target.read_into(measured, components=2, dtype="f4")
        return measured


class _Stock:
    """A scene's triangles on the GPU."""

    def __init__(self, context: Any, programs: dict[str, Any], scene: Scene) -> None:
        self.pieces = Pieces(scene)
        self._chosen: Any = None
        # Never empty: OpenGL has no empty buffers.
        self._vertices = context.buffer(self.pieces.vertices.tobytes() or bytes(VERTEX.itemsize))
        self._order = context.buffer(reserve=max(4 * self.pieces.largest_order(), 4), dynamic=True)
        self.matrices = context.texture((3, max(len(scene.objects), 1)), 4, dtype="f4")
        self.matrices.filter = (context.NEAREST, context.NEAREST)

        def array(program: str, layout: str, *names: str) -> Any:
            return context.vertex_array(programs[program], [(self._vertices, layout, *names)], self._order)

        whole = ("3f 3f 4f1 1f", "in_position", "in_normal", "in_color", "in_row")
        self.shown = array("object", *whole)
        self._made = [self.shown, self._vertices, self._order, self.matrices]
        self.textured: Any = None
        if len(self.pieces.uvs):
            uvs = context.buffer(self.pieces.uvs.tobytes())
            parts = [(self._vertices, *whole), (uvs, "3f", "in_uv")]
            self.textured = context.vertex_array(programs["object_textured"], parts, self._order)
            self._made += [self.textured, uvs]
        self.shadow = array("shadow", "3f 16x 1f", "in_position", "in_row")
        self.measured = array("measure", "3f 16x 1f", "in_position", "in_row")
        self._made += [self.shadow, self.measured]

    def place(self, placed: NDArray[np.float32]) -> None:
        """Uploads the objects' 3×4 matrices."""
        if len(placed):
            self.matrices.write(np.ascontiguousarray(placed).tobytes())

    def choose(self, order: NDArray[np.uint32]) -> int:
        """Uploads the triangles to draw next; returns the number of their indices."""
        if len(order):
            self._order.orphan()
            self._order.write(order)
        return len(order)

    def release(self) -> None:
        """Frees the buffers."""
        for thing in self._made:
            thing.release()


def _make_context() -> Any:
    try:
        import moderngl  # noqa: PLC0415 - needs libEGL, which may be missing

        options: dict[str, Any] = {"standalone": True, "require": 330, "backend": "egl"}
        return moderngl.create_context(**options)
    except Exception as error:
        raise RenderError(str(error).splitlines()[0] if str(error) else type(error).__name__) from error


def _finished(picture: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Smooths the edges of a picture of RGBA rows in place, and returns it as RGB."""
    return _rgb(smoothed(picture))


def _rgb(picture: NDArray[np.uint8]) -> NDArray[np.uint8]:
    return np.asarray(cv2.cvtColor(picture, cv2.COLOR_RGBA2RGB), np.uint8)


def _upside_down(view: Viewpoint, width: int, height: int) -> NDArray[np.float64]:
    """Returns the transform from the world to clip space, with the top row first."""
    matrix: NDArray[np.float64] = np.diag([1.0, -1.0, 1.0, 1.0]) @ view.projection_matrix(width, height)
    return matrix @ view.view_matrix()


def _translation(by: tuple[float, float, float]) -> NDArray[np.float64]:
    matrix = np.eye(4)
    matrix[:3, 3] = by
    return matrix


def _bytes(matrix: NDArray[np.floating[Any]]) -> bytes:
    return matrix.T.astype(np.float32).tobytes()
