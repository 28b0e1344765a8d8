"""Bodies, robots and actors in PyBullet."""
