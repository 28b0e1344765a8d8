"""The runs of a session: what is recorded of them, and how they ended."""
