"""`bt-studio hosts`: manages further machines on which a team's server starts executors."""

from __future__ import annotations

import sys
from typing import Annotated

import typer

from backend.cli.shared.errors import BAD_ARGUMENTS, CliError

hosts = typer.Typer(
    name="hosts",
    help="Further machines with Docker (BT_STUDIO_EXECUTOR_HOSTS).",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)


@hosts.callback()
def _root() -> None:
    """Further machines with Docker (BT_STUDIO_EXECUTOR_HOSTS)."""


@hosts.command()
def certificate(
    host: Annotated[str, typer.Argument(help="Name or address of the host, as the setting has it.")],
) -> None:
    """Makes or renews the certificates of a host and of this web server, for 90 days.

    That of the host is printed with its private key, for a file of that host that only its relay reads.
    """
    from backend.config.environment import environment
    from backend.sessions.hosts.authority import AuthorityError, host_bundle, renew_web_bundle, valid_until
    from backend.sessions.hosts.names import read_host

    listed = {read_host(text).name for text in environment().executor_hosts}
    name = host.lower().strip("[]")
    if name not in listed:
        said = ", ".join(sorted(listed)) or "empty"
        raise CliError(
            f"{host} is not in BT_STUDIO_EXECUTOR_HOSTS, which is {said}: add it there first.",
            status=BAD_ARGUMENTS,
        )
    folder = environment().hosts_folder
    try:
        renew_web_bundle(folder)
        made = host_bundle(folder, name)
    except AuthorityError as error:
        raise CliError(str(error)) from error
    sys.stdout.write(made)
    print(f"The certificate of {name} is valid until {valid_until(made):%Y-%m-%d}.", file=sys.stderr)


@hosts.command()
def check() -> None:
    """Asks the keeper of each host how many executors and tools may still start there.

    The exit status is 1 if a host is not reached.
    """
    from backend.config.environment import environment
    from backend.sessions.errors import LaunchError
    from backend.sessions.hosts.names import read_host
    from backend.sessions.launchers.relayed import RelayedLauncher

    if not environment().executor_hosts:
        raise CliError("BT_STUDIO_EXECUTOR_HOSTS is empty.", status=BAD_ARGUMENTS)
    problems = []
    for text in environment().executor_hosts:
        try:
            room = RelayedLauncher(read_host(text)).room()
        except LaunchError as error:
            problems.append(f"{text}: {error.detail}")
        else:
            print(
                f"{text}: {room.free} of {room.places} executors may start, and tools for {room.free_tools}."
            )
    if problems:
        raise CliError(*problems)
