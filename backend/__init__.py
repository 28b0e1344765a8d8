"""The web server: projects, sessions, and the command line."""
