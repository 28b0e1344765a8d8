"""The gate: passes sockets to containers without any network.

A session's container has no network, and nothing that it can write is shared with anyone. When it starts it
connects to its door, a unix socket that it sees through a read-only mount, shows its token there, and is
handed a socket that listens already, at a path that only the web server and the keeper see. From then on the
web server and the session talk to each other alone; a restart of the gate, the keeper or the web server
changes nothing.

The gate is a program and a container of its own, because every session may speak to it: it has no network,
no Docker socket, no secrets, one thread, and bounds on everything. The standard library is all it uses:

    doors       `<32 random hex>/gate.sock`, a folder for each session, in a volume that nobody can list
    callers     connections that have not yet shown a token: their limits, and which are closed first
    server      the loop: opens doors for the keeper, and passes sockets to sessions
    client      the keeper's messages to the gate
    probe       the health check, which goes through the gate as a session does
    errors      errors with a code and a hint
"""
