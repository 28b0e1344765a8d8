"""Measurements of robots and cameras."""
