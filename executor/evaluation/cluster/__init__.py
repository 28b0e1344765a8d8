"""Evaluations on a Ray cluster: batches of seeds, each run by a supervisor of its own."""
