"""Functions for the commands that work on stored projects."""

from __future__ import annotations

import os
from collections.abc import Iterator  # noqa: TC003
from contextlib import contextmanager
from typing import TYPE_CHECKING

from backend.cli.shared.errors import BAD_ARGUMENTS, CliError

if TYPE_CHECKING:
    from backend.projects.models import Project


@contextmanager
def stored_projects() -> Iterator[None]:
    """Opens the data folder (`BT_STUDIO_DATA_DIR`). Errors of projects become errors of the command line.

    A server may run at the same time: the database makes both write in turn.
    """
    os.environ.setdefault("DJANGO_SETTINGS_MODULE", "backend.config.settings")
    from backend.config.environment import InvalidEnvironmentError, environment
    from backend.config.server import ServeError, make_data_folder, migrate

    try:
        make_data_folder(environment().data_dir)
        migrate()
    except InvalidEnvironmentError as error:
        raise CliError(str(error), status=BAD_ARGUMENTS) from error
    except ServeError as error:
        raise CliError(str(error)) from error
    from backend.core.problems import StudioError

    try:
        yield
    except StudioError as error:
        raise CliError(
            f"{error.code}: {error.detail}" + (f" ({error.hint})" if error.hint else "")
        ) from error
    except OSError as error:
        raise CliError(f"{error.filename}: {error.strerror}") from error


def find_project(name_or_id: str) -> Project:
    """Returns the stored project with this name or id."""
    from uuid import UUID

    from backend.accounts.writes import local_user
    from backend.projects.storage import queries
    from backend.projects.storage.access import Need

    try:
        project_id = UUID(name_or_id)
    except ValueError:
        return queries.project_named(name_or_id, user=local_user())
    return queries.project(project_id, user=local_user(), need=Need.MANAGE)
