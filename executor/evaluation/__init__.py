"""Evaluations: many seeded runs of a project in varied worlds, judged on the truth, with their statistics."""
