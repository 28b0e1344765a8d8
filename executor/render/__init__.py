"""Renders the world: robots' cameras, and the server's own view for browsers without WebGL."""

from executor.render.choose import make_renderer
from executor.render.interface import GROUND, NOTHING, Renderer, RenderError, Viewpoint, look_at

__all__ = ["GROUND", "NOTHING", "RenderError", "Renderer", "Viewpoint", "look_at", "make_renderer"]
