"""A user who means harm, and another who works meanwhile; for `tests/docker` and `tests/backend`."""
