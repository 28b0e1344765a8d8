"""The shader compiler leaves the memory when its work is done, and is loaded again on demand."""

import re
from pathlib import Path

import numpy as np

from executor.messages import Light, Scene, SceneObject, Shape
from executor.render import look_at
from executor.render.compiler import release_compiler
from executor.render.gl import SETTLED, GlRenderer

IDENTITY = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
VIEW = look_at((3, 3, 2), (0, 0, 0.5), 0.9)
POSES = np.array([[0, 0, 0.5, 0, 0, 0, 1]], np.float32)


def code_kb() -> int:
    """Returns how much of the compiler's code is in this process's memory, in KB."""
    total, counts = 0, False
    for line in Path("/proc/self/smaps").read_text().splitlines():
        if re.match(r"^[0-9a-f]+-[0-9a-f]+ ", line):
            counts = " r-xp " in line and "libLLVM" in line
        elif counts and line.startswith("Rss:"):
            total += int(line.split()[1])
    return total


def scene() -> Scene:
    thing = SceneObject(0, "box", "", "static", [Shape("box", [1, 1, 1], IDENTITY, [0, 1, 0, 1])], IDENTITY)
    return Scene("test", 0.0, [thing], {}, [Light([0.2, 0.3, -0.9], 1.0)], [0.8, 0.8, 0.8, 1.0], [])


def test_it_goes_when_a_scene_has_settled_and_returns_for_the_next() -> None:
    renderer = GlRenderer()
    renderer.load(scene())
    first = renderer.draw(POSES, VIEW, 160, 120)
    busy = code_kb()
    for _ in range(SETTLED):
        last = renderer.draw(POSES, VIEW, 160, 120)
    np.testing.assert_array_equal(first, last)
    if "llvmpipe" in renderer.name:
        assert busy > 5_000
        assert code_kb() < busy / 4
    renderer.close()
    again = GlRenderer()  # compiles all of it again
    again.load(scene())
    np.testing.assert_array_equal(again.draw(POSES, VIEW, 160, 120), first)
    again.close()


def test_it_may_be_called_at_any_time() -> None:
    assert release_compiler() >= 0
    assert release_compiler() >= 0
