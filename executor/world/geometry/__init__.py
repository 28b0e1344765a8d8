"""Poses, meshes and visual shapes: pure functions, without a physics engine."""
