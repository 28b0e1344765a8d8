"""Live runs in a session."""
