"""Poses, meshes and what things look like: pure, without a physics engine."""
