"""Changes of a running program: ports, and the whole project."""
