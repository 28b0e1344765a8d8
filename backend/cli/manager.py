"""`bt-studio manager`: runs the executor's manager alone, for the back end or for another client."""

from __future__ import annotations

import sys
from pathlib import Path  # noqa: TC003 - read at run time
from typing import Annotated

import typer


def manager(  # noqa: PLR0913, PLR0917 - one an option
    host: Annotated[str, typer.Option(help="Address to listen on.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(min=0, max=65535, help="Port; 0 takes a free one.")] = 7163,
    token_env: Annotated[
        str,
        typer.Option(
            help="Environment variable with the token that clients must show; else one is made and printed."
        ),
    ] = "",
    no_token: Annotated[  # noqa: FBT002 - typer's way
        bool, typer.Option("--no-token", help="Ask for no token, on loopback, of this machine's pages alone.")
    ] = False,
    ready_fd: Annotated[
        int | None, typer.Option(help="File descriptor that receives the port, as a line of JSON.")
    ] = None,
    domain_id: Annotated[int | None, typer.Option(min=0, max=101, help="ROS domain of the session.")] = None,
    grace: Annotated[
        float | None,
        typer.Option(min=0, help="Seconds that it lives without clients; 0: without end. 300, with --ram 0."),
    ] = None,
    ram: Annotated[  # noqa: FBT002 - typer's way
        bool, typer.Option("--ram", help="Speak the protocol of JdeRobot's RAM, on loopback alone.")
    ] = False,
    no_recording: Annotated[  # noqa: FBT002 - typer's way
        bool, typer.Option("--no-recording", help="Keep no recording of the runs.")
    ] = False,
    recordings: Annotated[
        Path | None, typer.Option(help="Folder for the recordings of the runs; it stays at the end.")
    ] = None,
    attach: Annotated[
        str, typer.Option(help="HOST:PORT of a program whose tree it follows by Groot2's protocol.")
    ] = "",
    tls_cert: Annotated[
        Path | None, typer.Option(help="Certificate, as PEM, with which connections are encrypted.")
    ] = None,
    tls_key: Annotated[Path | None, typer.Option(help="Its private key, as PEM.")] = None,
    allow_origin: Annotated[
        list[str] | None,
        typer.Option(help="Page that may drive it, such as https://example.org; repeatable."),
    ] = None,
) -> None:
    """Serves one session of world and application."""
    from executor.manager.manager import main

    arguments = ["--host", host, "--port", str(port), *(["--ram"] if ram else [])]
    arguments += ["--no-token"] if no_token else []
    arguments += ["--no-recording"] if no_recording else []
    for origin in allow_origin or []:
        arguments += ["--allow-origin", origin]
    for name, value in (
        ("--token-env", token_env or None),
        ("--ready-fd", ready_fd),
        ("--domain-id", domain_id),
        ("--grace", grace),
        ("--recordings", recordings),
        ("--attach", attach or None),
        ("--tls-cert", tls_cert),
        ("--tls-key", tls_key),
    ):
        if value is not None:
            arguments += [name, str(value)]
    sys.exit(main(arguments))
