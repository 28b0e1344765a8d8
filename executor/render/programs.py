"""Compiles the shader programs for the available OpenGL."""

from __future__ import annotations

from typing import Any, Final

from executor.render import shaders, shadow

GATHER_VERSION: Final = 400

SOURCES: Final = {
    "shadow": (shaders.SHADOW_VERTEX, shaders.SHADOW_FRAGMENT),
    "object": (shaders.OBJECT_VERTEX, shaders.OBJECT_FRAGMENT),
    "ground": (shaders.GROUND_VERTEX, shaders.GROUND_FRAGMENT),
    "sky": (shaders.SKY_VERTEX, shaders.SKY_FRAGMENT),
    "measure": (shaders.MEASURE_VERTEX, shaders.MEASURE_FRAGMENT),
    "measure_ground": (shaders.MEASURE_GROUND_VERTEX, shaders.MEASURE_FRAGMENT),
}


TEXTURED: Final = {
    "object_textured": (shaders.TEXTURED_VERTEX, shaders.TEXTURED_FRAGMENT),
    "ground_textured": (shaders.GROUND_VERTEX, shaders.TEXTURED_GROUND_FRAGMENT),
}
"""Shader programs that only scenes with textures need."""


def compile_all(
    context: Any, *, gather: bool, sources: dict[str, tuple[str, str]] = SOURCES
) -> dict[str, Any]:
    """Returns all programs by name.

    Args:
        context: the context of moderngl.
        gather: whether to filter shadows in the shader, which is faster than the sampler on a CPU.
        sources: vertex and fragment shaders by name.
    """
    gather = gather and context.version_code >= GATHER_VERSION
    head = f"#version {GATHER_VERSION if gather else 330}\n"
    if gather:
        head += f"#define GATHER\n#define SHADOW_SIZE {shadow.SIZE}.0\n"
    return {
        name: context.program(vertex_shader=head + vertex, fragment_shader=head + fragment)
        for name, (vertex, fragment) in sources.items()
    }
