"""Ray casting.

Intersections with static boxes and cylinders are computed in this module, for all rays in one operation.

A ray costs several microseconds in the physics server, mostly because of walls and shelves. So a ray is cast
in the physics server only if it enters the bounding box of another body before it hits a static box or
cylinder.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Final

import numpy as np

from executor.world.geometry.transforms import rotation

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from executor.world.engine import Bullet

    Floats = NDArray[np.float64]
    Halves = tuple[float, float, float]

# Bullet's shapes extend slightly beyond their bounding boxes.
MARGIN_M: Final = 0.01


class RayCaster:
    """Casts rays into one world, whose floor is at z = 0.

    Create a new caster whenever the content of the world is created.

    Args:
        bullet: the physics server.
    """

    def __init__(self, bullet: Bullet) -> None:
        self._bullet = bullet
        self._boxes: dict[int, Halves] = {}
        self._cylinders: dict[int, Halves] = {}
        self._still: list[_Still] = []
        self._others: list[tuple[int, int]] = []

    def add_still_box(self, uid: int, size: Sequence[float]) -> None:
        """Adds a static box; its size is in m."""
        x, y, z = (length / 2 for length in size)
        self._boxes[uid] = (x, y, z)

    def add_still_cylinder(self, uid: int, radius: float, length: float) -> None:
        """Adds a static cylinder along its z axis; radius and length are in m."""
        self._cylinders[uid] = (radius, radius, length / 2)

    def add_body(self, uid: int) -> None:
        """Adds a body of any shape."""
        links = range(-1, self._bullet.getNumJoints(uid))
        # For a static body with a single link, Bullet reports no shape although there is one.
        solid = [link for link in links if len(links) == 1 or self._bullet.getCollisionShapeData(uid, link)]
        self._others += [(uid, link) for link in solid]

    def moved(self) -> None:
        """Notes that a static body was moved."""
        self._still = []

    def cast(self, origin: Sequence[float], rays: Floats, own: int, mask: int) -> Floats:
        """Returns, for each ray, the share of its length before the first hit; 1 without a hit.

        A ray that begins within a body leaves it without a hit.

        Args:
            origin: the origin of all rays, in m.
            rays: (3, n), the vectors from the origin to the ends of the rays, in m.
            own: the body that carries the sensor, which the rays do not hit.
            mask: the collision filter of Bullet, without the group of that body.
        """
        start = np.asarray(origin, np.float64)
        shares = _to_ground(start, rays)
        for still in self._where_still():
            shares = np.minimum(shares, still.cast(start, rays))
        chosen = np.flatnonzero(self._enters_others(start, rays, own, shares))
        if len(chosen):
            ends = (rays[:, chosen].T + start).tolist()
            starts = [start.tolist()] * len(chosen)
            hits = self._bullet.rayTestBatch(starts, ends, numThreads=1, collisionFilterMask=mask)
            found = np.fromiter((hit[2] for hit in hits), np.float64, len(hits))
            shares[chosen] = np.minimum(shares[chosen], found)
        return shares

    def _where_still(self) -> list[_Still]:
        if not self._still:
            for kind, bodies in ((_Boxes, self._boxes), (_Cylinders, self._cylinders)):
                poses = [self._bullet.getBasePositionAndOrientation(uid) for uid in bodies]
                self._still.append(kind(poses, list(bodies.values())))
        return self._still

    def _enters_others(self, start: Floats, rays: Floats, own: int, shares: Floats) -> NDArray[np.bool_]:
        around = [self._bullet.getAABB(uid, link) for uid, link in self._others if uid != own]
        if not around:
            return np.zeros(len(shares), np.bool_)
        corners = np.array(around)
        low, high = _reach(start, rays, MARGIN_M)
        corners = corners[np.all((corners[:, 1] >= low) & (corners[:, 0] <= high), axis=1)]
        if not len(corners):
            return np.zeros(len(shares), np.bool_)
        middles, halves = corners.mean(axis=1), (corners[:, 1] - corners[:, 0]) / 2 + MARGIN_M
        everywhere = np.broadcast_to(rays, (len(corners), *rays.shape))
        near, far = _Boxes.crossings(start - middles, everywhere, halves)
        is_entered = (near <= np.minimum(far, shares)) & (far > 0)
        entered: NDArray[np.bool_] = np.logical_or.reduce(is_entered, axis=0)
        return entered


class _Still(ABC):
    """Static bodies of one shape, at their current poses."""

    def __init__(self, poses: list[tuple[Sequence[float], Sequence[float]]], halves: list[Halves]) -> None:
        count = len(poses)
        self._centres = np.array([position for position, _ in poses]).reshape(count, 3)
        self._turns = np.array([rotation(turn) for _, turn in poses]).reshape(count, 3, 3)
        self._halves = np.array(halves).reshape(count, 3)
        # Half the extent of each along the world's axes.
        self._reaches = (np.abs(self._turns) @ self._halves[:, :, None])[:, :, 0]

    def cast(self, start: Floats, rays: Floats) -> Floats:
        """Returns, for each ray, the share of its length before it enters the first body.

        1 if it enters none.
        """
        low, high = _reach(start, rays)
        is_near = np.all(
            (self._centres + self._reaches >= low) & (self._centres - self._reaches <= high), axis=1
        )
        if not is_near.any():
            return np.ones(rays.shape[1])
        inwards = self._turns[is_near].transpose(0, 2, 1)
        starts = (inwards @ (start - self._centres[is_near])[:, :, None])[:, :, 0]
        near, far = self.crossings(starts, inwards @ rays, self._halves[is_near])
        first: Floats = np.where((near <= far) & (near >= 0), near, 1.0).min(axis=0, initial=1.0)
        return first

    @staticmethod
    @abstractmethod
    def crossings(starts: Floats, rays: Floats, halves: Floats) -> tuple[Floats, Floats]:
        """Returns the points at which lines enter and leave the bodies, as shares of the rays' lengths.

        Args:
            starts: (m, 3), the origin of the rays in the frame of each body.
            rays: (m, 3, n), the rays in the frame of each body.
            halves: (m, 3), half the size of each body.
        """


class _Boxes(_Still):
    @staticmethod
    def crossings(starts: Floats, rays: Floats, halves: Floats) -> tuple[Floats, Floats]:
        """Returns the shares at which lines enter and leave boxes, by the slab method."""
        near, far = _between(starts, rays, halves)
        return np.fmax.reduce(near, axis=1), np.fmin.reduce(far, axis=1)


class _Cylinders(_Still):
    """Cylinders about z; their half sizes along x and y are the radius."""

    @staticmethod
    def crossings(starts: Floats, rays: Floats, halves: Floats) -> tuple[Floats, Floats]:
        """Returns the shares at which lines enter and leave cylinders.

        It solves a quadratic about the axis, and uses a slab along it.
        """
        along, across = (rays[:, :2] ** 2).sum(axis=1), (starts[:, :2, None] * rays[:, :2]).sum(axis=1)
        outside = (starts[:, :2] ** 2).sum(axis=1) - halves[:, 0] ** 2
        with np.errstate(divide="ignore", invalid="ignore"):
            root = np.sqrt(across**2 - along * outside[:, None])  # NaN if the line misses
            enters, leaves = (-across - root) / along, (-across + root) / along
        is_inside = (along == 0) & (outside[:, None] <= 0)
        enters, leaves = np.where(is_inside, -np.inf, enters), np.where(is_inside, np.inf, leaves)
        near, far = _between(starts[:, 2:], rays[:, 2:], halves[:, 2:])
        return np.maximum(enters, near[:, 0]), np.minimum(leaves, far[:, 0])


def _between(starts: Floats, rays: Floats, halves: Floats) -> tuple[Floats, Floats]:
    """Returns the shares at which lines enter and leave the slab of each axis."""
    with np.errstate(divide="ignore", invalid="ignore"):
        inverse = 1.0 / rays
        first = (-halves - starts)[:, :, None] * inverse
        second = (halves - starts)[:, :, None] * inverse
    # A line within a plane gives 0 · ∞ (NaN), which is no limit.
    return np.fmin(first, second), np.fmax(first, second)


def _reach(start: Floats, rays: Floats, margin_m: float = 0.0) -> tuple[Floats, Floats]:
    """Returns the corners of the box that holds all rays."""
    return (
        start + np.minimum(rays.min(axis=1), 0) - margin_m,
        start + np.maximum(rays.max(axis=1), 0) + margin_m,
    )


def _to_ground(start: Floats, rays: Floats) -> Floats:
    down = -rays[2]
    with np.errstate(divide="ignore", invalid="ignore"):
        shares = np.where((down > 0) & (start[2] >= 0), start[2] / down, 1.0)
    return np.minimum(shares, 1.0)
