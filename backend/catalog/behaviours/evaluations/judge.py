"""Judges of the library's behaviours: what the robot truly did, from where it began."""

import math


def moved(truth):
    """Returns where the robot is, seen from its start, and by how much it turned."""
    first, last = truth.samples[0], truth.samples[-1]
    dx, dy = last.x - first.x, last.y - first.y
    cosine, sine = math.cos(first.yaw), math.sin(first.yaw)
    ahead = dx * cosine + dy * sine
    steps = [
        math.remainder(after.yaw - before.yaw, math.tau)
        for before, after in zip(truth.samples, truth.samples[1:], strict=False)
    ]
    turned = math.degrees(sum(steps))
    return {
        "ahead_m": ahead,
        "along_m": abs(ahead),
        "left_m": dy * cosine - dx * sine,
        "turned_deg": turned,
        "away_deg": abs(math.degrees(math.remainder(last.yaw - first.yaw, math.tau))),
    }


def travelled(truth):
    """Returns the length of the way."""
    return {"travelled_m": truth.path_length_m}


def facing_post(truth):
    """Returns by how much the robot looks past what is behind its start."""
    last = truth.samples[-1]
    return {"off_deg": abs(math.degrees(math.remainder(last.yaw - math.pi, math.tau)))}


def square(truth):
    """Returns how many corners of the square were visited in order, each within 20 cm."""
    first = truth.samples[0]
    cosine, sine = math.cos(first.yaw), math.sin(first.yaw)
    corners = [(1, 0), (1, 1), (0, 1), (0, 0)]
    found = 0
    for now in truth.samples:
        dx, dy = now.x - first.x, now.y - first.y
        here = (dx * cosine + dy * sine, dy * cosine - dx * sine)
        if found < len(corners) and math.dist(here, corners[found]) <= 0.2:
            found += 1
    return {"corners": found}
