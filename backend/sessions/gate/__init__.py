"""The gate: passes sockets to containers that have no network.

The container of a session has no network, and shares no folder that it can write. When it starts, it connects
to its "door", a unix socket that it sees through a read-only mount, and sends its token. It receives a
listening socket, whose path only the web server and the keeper see. From then on the web server and the
session communicate directly; a restart of the gate, the keeper or the web server does not disturb them.

The gate is a separate program in its own container, because every session can send messages to it. It has no
network, no Docker socket, no secrets and only one thread, and everything in it is limited. It uses only the
standard library:

    doors       `<32 random hex>/gate.sock`, a folder for each session, in a volume that cannot be listed
    callers     connections that have not yet shown a token: their limits, and which are closed first
    server      the loop: opens doors for the keeper, and passes sockets to sessions
    client      the keeper's messages to the gate
    probe       the health check, which goes through the gate as a session does
    errors      errors with a code and a hint
"""
