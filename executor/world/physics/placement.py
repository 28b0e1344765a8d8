"""The only place that puts a body somewhere: at reset, at a drag, and for actors, which are moved by nature.

Robots move by their wheels and by contact alone;
`tests/executor/world/physics/test_motion_lint.py` holds us to it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from executor.world.engine import Bullet
    from executor.world.geometry.transforms import Pose


def put(bullet: Bullet, body: int, pose: Pose) -> None:
    """Puts the base of a body somewhere."""
    bullet.resetBasePositionAndOrientation(body, pose[:3], pose[3:])


def put_at_rest(bullet: Bullet, body: int, pose: Pose) -> None:
    """Puts a body somewhere, without motion."""
    put(bullet, body, pose)
    bullet.resetBaseVelocity(body, (0, 0, 0), (0, 0, 0))
