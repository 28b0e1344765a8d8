"""Reads and makes point clouds."""
