"""Debugs the Python of an application: the connection with debugpy, and what keeps it true and bounded."""
