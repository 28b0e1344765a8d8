"""A hostile user, and another one who works meanwhile; for `tests/docker` and `tests/backend`."""
