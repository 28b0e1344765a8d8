"""Exact runs in a session."""
