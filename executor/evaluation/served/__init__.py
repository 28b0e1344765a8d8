"""The programs of an evaluation that a session or the web server starts."""
