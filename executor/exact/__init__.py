"""Exact runs: world, tree and actions in one process, in lock-step, paced to real time."""
