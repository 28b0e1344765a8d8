"""Tools that read one user's files for the editor: the language server, and ruff.

On a team's server they run in a container of the executor image, one a user, without a network and with
limits: a file that exploits a parser can harm neither the web server nor another user.
The web server sends files and bytes and relays the answers (`backend/language/containers.py`).

    server      the unix socket, its access rules and its life
    language    one open editor and a language server of its own
    checker     one run of ruff
"""
