"""`bt-studio manager`: the executor's manager alone, for the back end or for another client."""

from __future__ import annotations

import sys
from typing import Annotated

import typer


def manager(  # noqa: PLR0913, PLR0917 - one an option
    host: Annotated[str, typer.Option(help="Address to listen on.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(min=0, max=65535, help="Port; 0 takes a free one.")] = 7163,
    token_env: Annotated[
        str, typer.Option(help="Environment variable with the token that clients must send.")
    ] = "",
    ready_fd: Annotated[
        int | None, typer.Option(help="File descriptor that is told the port, as a line of JSON.")
    ] = None,
    domain_id: Annotated[int | None, typer.Option(min=0, max=101, help="ROS domain of the session.")] = None,
    grace: Annotated[
        float, typer.Option(min=0, help="Seconds that the session lives without clients; 0: for ever.")
    ] = 300.0,
) -> None:
    """Serves one session of world and application."""
    from executor.manager import main

    arguments = ["--host", host, "--port", str(port), "--grace", str(grace)]
    for name, value in (
        ("--token-env", token_env or None),
        ("--ready-fd", ready_fd),
        ("--domain-id", domain_id),
    ):
        if value is not None:
            arguments += [name, str(value)]
    sys.exit(main(arguments))
