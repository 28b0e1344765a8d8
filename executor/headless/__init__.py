"""Runs of a project without a browser: in real time, and in lock-step."""
