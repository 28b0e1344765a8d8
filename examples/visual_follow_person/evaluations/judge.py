"""Judges how well the robot follows."""

import math

NEAR_M = 2.5


def following(truth):
    """Returns the share of the time that the robot is near the person."""
    near = [math.dist((now.x, now.y), now.actors["person"]) <= NEAR_M for now in truth.samples]
    return {"share_near": sum(near) / len(near)}
