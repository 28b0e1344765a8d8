"""The keeper: the only program that talks to Docker; through it the web server can only start executors.

It runs beside the web server, holds the Docker socket, and has no network. It receives ids and tokens of
sessions, never images, mounts, commands or limits: these are set by the keeper. The keeper uses only the
standard library, so that the code with root rights on the host stays small enough to be reviewed:

    docker      the Docker Engine's API over its socket
    plan        what an executor's container may do, and its limits
    gate        requests doors from the gate, a separate program that passes sockets to executors
    service     starts, inspects and stops executors, and ends those that run too long
    tools       containers that read users' files for the editor
    group       whether Docker's socket may be used
    server      the five requests that the web server may make
"""
