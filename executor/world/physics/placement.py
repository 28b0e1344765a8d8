"""Sets the poses of bodies; no other module does.

They are set at a reset, when a user drags a body, and for actors, which are moved by design.

Robots move only by their wheels and by contact;
`tests/executor/world/physics/test_motion_lint.py` checks this.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from executor.world.engine import Bullet
    from executor.world.geometry.transforms import Pose


def put(bullet: Bullet, body: int, pose: Pose) -> None:
    """Sets the pose of the base of a body."""
    bullet.resetBasePositionAndOrientation(body, pose[:3], pose[3:])


def put_at_rest(bullet: Bullet, body: int, pose: Pose) -> None:
    """Sets the pose of a body, with zero velocity."""
    put(bullet, body, pose)
    bullet.resetBaseVelocity(body, (0, 0, 0), (0, 0, 0))
