"""Stored runs: recordings of sessions that users keep with their projects."""
