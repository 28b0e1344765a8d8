"""Rays: our results equal those of the physics server, and where these differ, those of geometry."""

from __future__ import annotations

import math

import numpy as np
import pytest

from executor.world.engine import Bullet
from executor.world.geometry.transforms import from_xyz_rpy, rotation
from executor.world.sensing.rays import RayCaster

ALL = 0x7FFF
LENGTH_M = 9.0


@pytest.fixture
def bullet():
    made = Bullet()
    yield made
    made.close()


def body(bullet, pose, mass=0.0, **shape):
    x, y, z, *turn = from_xyz_rpy(pose)
    return bullet.createMultiBody(
        mass,
        bullet.createCollisionShape(**shape),
        basePosition=(x, y, z),
        baseOrientation=turn,
        useMaximalCoordinates=mass == 0,
    )


def box(bullet, size, pose, mass=0.0):
    halves = [length / 2 for length in size]
    return body(bullet, pose, mass, shapeType=bullet.GEOM_BOX, halfExtents=halves)


def cylinder(bullet, radius, length, pose):
    return body(bullet, pose, shapeType=bullet.GEOM_CYLINDER, radius=radius, height=length)


def fan(angles, pose=(0.0,) * 6):
    flat = np.stack([np.cos(angles), np.sin(angles), np.zeros_like(angles)]) * LENGTH_M
    return rotation(from_xyz_rpy(pose)[3:]) @ flat


def by_bullet(bullet, start, rays):
    ends = (rays.T + start).tolist()
    hits = bullet.rayTestBatch([list(start)] * len(ends), ends)
    return np.array([hit[2] for hit in hits])


def litter(bullet, rays, rng):
    """Static and moving boxes and cylinders, none at the origin of the rays."""
    for kind in ("box", "cylinder", "loose") * 4:
        away, at = rng.uniform(1.5, 6.0), rng.uniform(-math.pi, math.pi)
        tilt = rng.normal(0, 0.3, 2) if rng.random() < 0.5 else (0.0, 0.0)
        pose = (away * math.cos(at), away * math.sin(at), rng.uniform(-0.5, 0.5), *tilt, rng.uniform(-3, 3))
        size = rng.uniform(0.1, 1.2, 3)
        if kind == "box":
            rays.add_still_box(box(bullet, size, pose), size)
        elif kind == "cylinder":
            rays.add_still_cylinder(cylinder(bullet, size[0] / 2, size[1], pose), size[0] / 2, size[1])
        else:
            rays.add_body(box(bullet, size, pose, mass=1.0))


@pytest.mark.parametrize("seed", range(8))
def test_rays_end_where_the_physics_server_s_do(bullet, seed):
    rng = np.random.default_rng(seed)
    rays = RayCaster(bullet)
    floor = [50, 50, 0.1]
    box(bullet, floor, (0, 0, -0.05, 0, 0, 0))
    litter(bullet, rays, rng)
    start = np.array([0.0, 0.0, 0.2])
    angles = np.arange(720) * math.tau / 720
    tilt = (0, 0, 0, *rng.normal(0, 0.05, 2), 0)
    ours = rays.cast(start.tolist(), fan(angles, tilt), -1, ALL)
    # Bullet passes an edge by a little, so a ray that grazes one may have its neighbour's result.
    near = np.array([by_bullet(bullet, start, fan(angles + turn, tilt)) for turn in (-0.01, 0.0, 0.01)])
    assert (ours < 1).sum() > 100
    assert np.all(ours * LENGTH_M > near.min(axis=0) * LENGTH_M - 0.01)
    assert np.all(ours * LENGTH_M < near.max(axis=0) * LENGTH_M + 0.01)


def test_distances_are_those_of_geometry(bullet):
    rays = RayCaster(bullet)
    rays.add_still_box(box(bullet, (0.2, 4, 1), (2, 0, 0.5, 0, 0, 0)), (0.2, 4, 1))
    rays.add_still_cylinder(cylinder(bullet, 0.5, 1.0, (0, 3, 0.5, 0, 0, 0)), 0.5, 1.0)
    lying = (-3, 0, 0.5, math.pi / 2, 0, 0)
    rays.add_still_cylinder(cylinder(bullet, 0.25, 2.0, lying), 0.25, 2.0)
    angles = np.array([0.0, math.pi / 2, math.pi, math.atan2(1, 1.9), -math.pi / 2])
    shares = rays.cast((0, 0, 0.5), fan(angles), -1, ALL)
    wanted = [1.9, 2.5, 2.75, math.hypot(1.9, 1), LENGTH_M]
    assert shares * LENGTH_M == pytest.approx(wanted, abs=1e-9)


def test_a_ray_may_run_along_a_side_and_begin_within_a_body(bullet):
    rays = RayCaster(bullet)
    rays.add_still_box(box(bullet, (1, 1, 1), (0, 0, 0.5, 0, 0, 0)), (1, 1, 1))
    rays.add_still_cylinder(cylinder(bullet, 0.2, 1, (2, 0, 0.5, 0, 0, 0)), 0.2, 1)
    down = np.array([[0.0, 0.0, -4.0]]).T
    inside = rays.cast((0, 0, 0.5), fan(np.array([0.0])), -1, ALL)
    assert inside * LENGTH_M == pytest.approx([1.8])
    along = rays.cast((0.5, -3, 0.5), fan(np.array([math.pi / 2])), -1, ALL)
    assert np.all(np.isfinite(along))
    assert rays.cast((2, 0, 2), down, -1, ALL) * 4 == pytest.approx([1.0])  # the cylinder's lid
    assert rays.cast((5, 5, 2), down, -1, ALL) * 4 == pytest.approx([2.0])  # the floor


def test_moving_bodies_are_hit_at_their_current_pose_and_the_own_body_never(bullet):
    rays = RayCaster(bullet)
    still = box(bullet, (1, 1, 1), (3, 0, 0.5, 0, 0, 0))
    loose = box(bullet, (0.4, 0.4, 0.4), (0, 2, 0.5, 0, 0, 0), mass=1.0)
    own = box(bullet, (0.4, 0.4, 0.4), (-1, 0, 0.5, 0, 0, 0), mass=1.0)
    bullet.setCollisionFilterGroupMask(own, -1, 1 << 8, ALL)
    rays.add_still_box(still, (1, 1, 1))
    rays.add_body(loose)
    rays.add_body(own)

    def look(angle):
        return rays.cast((0, 0, 0.5), fan(np.array([angle])), own, ALL & ~(1 << 8))[0] * LENGTH_M

    assert [look(a) for a in (0, math.pi / 2, math.pi)] == pytest.approx([2.5, 1.8, LENGTH_M], abs=1e-3)
    bullet.resetBasePositionAndOrientation(still, (4, 0, 0.5), (0, 0, 0, 1))
    rays.moved()
    bullet.resetBasePositionAndOrientation(loose, (0, 3, 0.5), (0, 0, 0, 1))
    assert [look(a) for a in (0, math.pi / 2)] == pytest.approx([3.5, 2.8], abs=1e-3)
