"""Evaluations: jobs that run a project in many seeded worlds, their outcomes, and replays of single runs."""
