"""Tuning: looks for the values of ports with which a project succeeds most often."""
