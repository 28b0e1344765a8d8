"""`bt-studio admin`: manages the accounts of a team's server from the terminal of its machine."""

from __future__ import annotations

import os
import sys
from contextlib import contextmanager
from pathlib import Path  # noqa: TC003 - read at run time
from typing import TYPE_CHECKING, Annotated

import typer

from backend.cli.shared.errors import BAD_ARGUMENTS, CliError
from backend.cli.shared.stored import stored_projects
from backend.cli.storage import storage

if TYPE_CHECKING:
    from collections.abc import Iterator

    from backend.accounts.models import User

PASSWORD_VARIABLE = "BT_STUDIO_ADMIN_PASSWORD"  # noqa: S105 - a name

admin = typer.Typer(
    name="admin",
    help="Accounts of a server with BT_STUDIO_MODE=team, and the object store of any.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
admin.add_typer(storage)


@contextmanager
def _accounts() -> Iterator[None]:
    with stored_projects():
        from backend.config.environment import environment

        if not environment().is_team:
            raise CliError(
                "There are no accounts in local mode: set BT_STUDIO_MODE=team.", status=BAD_ARGUMENTS
            )
        yield


@admin.command()
def create(  # noqa: PLR0913, PLR0917 - one parameter an option
    name: Annotated[str, typer.Argument(help="Name to sign in with.")],
    email: Annotated[str, typer.Option(help="E-mail address.")] = "",
    teacher: Annotated[bool, typer.Option("--teacher", help="May make groups and invite.")] = False,  # noqa: FBT002
    user: Annotated[bool, typer.Option("--user", help="No administrator.")] = False,  # noqa: FBT002
    password_stdin: Annotated[  # noqa: FBT002
        bool, typer.Option("--password-stdin", help="Read the password from the standard input.")
    ] = False,
    if_missing: Annotated[  # noqa: FBT002
        bool, typer.Option("--if-missing", help="Do nothing if the account exists.")
    ] = False,
    first: Annotated[  # noqa: FBT002
        bool, typer.Option("--first", help="Do nothing if there is an administrator who can sign in.")
    ] = False,
) -> None:
    """Makes an account: an administrator, unless --user or --teacher says otherwise.

    The password comes from the standard input or from BT_STUDIO_ADMIN_PASSWORD; without one, a link is
    printed that sets it.
    """
    password = sys.stdin.readline().rstrip("\n") if password_stdin else os.environ.get(PASSWORD_VARIABLE, "")
    with _accounts():
        from backend.accounts import writes
        from backend.accounts.sign_in import passwords

        if first and (present := writes.an_administrator()) is not None:
            print(f"{present.username} is an administrator.")
            if not present.has_usable_password():
                print(f"Set the password here, within three days: {passwords.link(present)}")
            return
        if if_missing and writes.user_named(name) is not None:
            print(f"{name} exists.")
            return
        made = writes.create_account(
            name, email=email, password=password, is_admin=not (teacher or user), is_teacher=teacher
        )
        print(f"{made.username} is made.")
        if not password:
            print(f"Set the password here, within three days: {passwords.link(made)}")


@admin.command(name="password-link")
def password_link(name: Annotated[str, typer.Argument(help="Name or e-mail of the account.")]) -> None:
    """Prints a link that sets a new password."""
    with _accounts():
        from backend.accounts.sign_in import passwords

        print(passwords.link(_user(name)))


@admin.command()
def invite(
    by: Annotated[str, typer.Option(help="Who invites: an administrator or a teacher.")],
    days: Annotated[int, typer.Option(min=1, max=365, help="How long the link works.")] = 14,
    uses: Annotated[int, typer.Option(min=1, max=10_000, help="For how many people.")] = 1,
) -> None:
    """Prints a link by which people make accounts."""
    with _accounts():
        from backend.accounts import invitations, links

        made = invitations.invite(acting_user=_user(by), group=None, days=days, max_uses=uses)
        print(links.link_of("join", made.id))


@admin.command()
def users() -> None:
    """Lists the accounts with their storage."""
    with _accounts():
        from backend.projects.storage.usage import usage_of_all

        for row in usage_of_all():
            mark = "admin" if row.is_superuser else "teacher" if row.is_teacher else "user"
            state = "" if row.is_active else "  deactivated"
            print(f"{row.username:30} {mark:8} {row.kept:5} projects {row.used or 0:12,} bytes{state}")


@admin.command()
def drain(
    message: Annotated[str, typer.Option(help="A message to the users, in addition.")] = "",
    wait: Annotated[int, typer.Option(min=0, max=1440, help="Minutes to wait for the last robot.")] = 0,
    off: Annotated[bool, typer.Option("--off", help="Let robots start again.")] = False,  # noqa: FBT002
) -> None:
    """Stops new robots from starting, notifies the users, and reports how many still run.

    With --wait it ends when the last robot has ended; the status is 1 if the time runs out first.
    """
    with _accounts():
        from backend.sessions.lifecycle import drain as drains

        if off:
            drains.lift(acting_user=None)
            print("Robots start again.")
            return
        drains.begin(message, acting_user=None)
        print("No robot starts any more; `bt-studio admin drain --off` ends this.")
        left = drains.wait_for_the_last(wait * 60, print)
        if wait and left:
            raise CliError(f"Time is up, and robots still run: {left}. An administrator may end them.")


@admin.command(name="export-user")
def export_user(
    name: Annotated[str, typer.Argument(help="Name or e-mail of the account.")],
    file: Annotated[Path, typer.Argument(help="The zip to write.")],
) -> None:
    """Writes all data of a user to a zip: account, log, drafts and projects."""
    with _accounts():
        from backend.accounts.audit import note
        from backend.projects.documents.personal_data import write_archive

        user = _user(name)
        try:
            with file.open("wb") as target:
                write_archive(user, target)
        except OSError as error:
            raise CliError(f"{file} cannot be written: {error.strerror}.") from error
        note("account.export", actor=None, subject=user.username, subject_id=user.pk, by="command line")
        print(f"All that is kept of {user.username} is in {file}.")


@admin.command(name="delete-user")
def delete_user(
    name: Annotated[str, typer.Argument(help="Name or e-mail of the account.")],
    yes: Annotated[bool, typer.Option("--yes", help="Do not ask.")] = False,  # noqa: FBT002
) -> None:
    """Deletes an account with all its projects; its changes elsewhere stay, without a name."""
    with _accounts():
        from backend.accounts.writes import delete_account
        from backend.core.problems import StudioError
        from backend.projects.storage.usage import usage

        user = _user(name)
        count = usage(user)["projects"]
        if not yes and not typer.confirm(f"Delete {user.username} with {count} projects for good?"):
            raise CliError("Nothing was deleted.")
        try:
            delete_account(user)
        except StudioError as error:
            raise CliError(error.detail) from error
        print(f"{user.username} is deleted, with {count} projects.")


def _user(name: str) -> User:
    from backend.accounts.writes import user_named

    found = user_named(name)
    if found is None:
        raise CliError(f"There is no account “{name}”.")
    return found
