"""Imports a robot, a world or a map from an uploaded file, in a child with limits."""
