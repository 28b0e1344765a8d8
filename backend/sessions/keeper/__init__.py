"""The keeper: the one program that talks to Docker, and lets the web server start executors and nothing else.

It runs beside the web server, holds the Docker socket, and has no network. It receives ids and tokens of
sessions, never images, mounts, commands or limits: those are its own. The standard library is all it uses,
so that what has root's power over the host can be read in one sitting:

    docker      the Docker Engine's API over its socket
    plan        what an executor's container may do, and its limits
    gate        how it has sockets handed to executors, by a gate that is a program of its own
    service     start, look, stop, and what has run too long
    tools       containers that read users' files for the editor
    group       whether Docker's socket may be used
    server      the five requests that the web server may make
"""
