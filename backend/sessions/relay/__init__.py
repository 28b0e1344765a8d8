"""The relay: ends TLS on a host with executors, and joins each stream to a socket of that host.

The web server of several hosts reaches the keeper and the sessions of each through its relay, a program in a
container of its own. It has no Docker socket; it sees the folder with the sockets of keeper and sessions, and
passes on bytes that it does not read. Only a certificate with the role of a web server is let in. It uses
only the standard library:

    hello       the first line of a stream, which names the socket
    tls         the certificates of both ends, read again when their file changes
    server      the loop: admits connections, and joins streams
"""
