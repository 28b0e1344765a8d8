"""Poses, meshes and visual shapes: pure, without a physics engine."""
