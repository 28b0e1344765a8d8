"""Tools that read the files of one user for the editor: the language server, and ruff.

On a team server they run in a container of the executor image, one for each user, without a network and with
limits: a file that exploits a parser can harm neither the web server nor another user. The web server sends
files and bytes and relays the answers (`backend/language/containers.py`).

    server      the unix socket, its access rules and its life
    language    one open editor with its own language server
    checker     one run of ruff
"""
