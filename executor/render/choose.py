"""Selects a renderer that works on this machine."""

from __future__ import annotations

import logging
import os

from executor.render.gl import GlRenderer
from executor.render.interface import Renderer, RenderError
from executor.render.tiny import TinyRenderer

_log = logging.getLogger(__name__)


def make_renderer(kind: str | None = None) -> Renderer:
    """Returns the renderer `gl` or `tiny`; without a name, the first one that works.

    The variable `BT_STUDIO_RENDERER` selects one if no name is given.
    """
    kind = kind or os.environ.get("BT_STUDIO_RENDERER") or None
    if kind == "tiny":
        return TinyRenderer()
    try:
        return GlRenderer()
    except RenderError as error:
        if kind == "gl":
            raise
        _log.warning("No EGL here, pictures are drawn by the slower TinyRenderer: %s", error)
        return TinyRenderer()
