"""What reads one user's files for the editor: the language server, and ruff.

On a team's server this runs in a container of the executor image, without a network and under limits, one a
user, so that neither the web server nor another user is there to be harmed by what a file does to a parser.
The web server sends files and bytes and relays what comes back (`backend/language/containers.py`).

    server      the unix socket, who may use it, and when it ends
    language    one open editor and a language server of its own
    checker     one run of ruff
"""
