"""Imports of robots, worlds and maps into a project."""
