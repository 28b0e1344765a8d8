"""Decides whether a backup can be restored here: it is of this version, or of an earlier one.

The rows of an earlier version are read with the tables of this one: a field that was added has its default,
and a table that was added is empty. That is right as long as the migrations between the two only add. Others
have to run on the data, so such a backup is refused.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from django.apps import apps
from django.db import connection
from django.db.migrations import operations
from django.db.migrations.loader import MigrationLoader
from django.db.models import NOT_PROVIDED

from backend.cli.shared.backup_error import BackupError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from django.db.migrations.operations.base import Operation
    from django.db.migrations.state import ProjectState
    from django.db.models import Field

__all__ = ["applied_migrations", "require_readable"]

# Rows of an earlier version fulfil what these leave.
_HARMLESS: Final = (
    operations.AddConstraint,
    operations.AddIndex,
    operations.AlterModelManagers,
    operations.AlterModelOptions,
    operations.CreateModel,
    operations.RemoveConstraint,
    operations.RemoveIndex,
)
# What a field says to forms and to Python alone; the rows do not depend on it.
_OF_FORMS: Final = frozenset(
    {"blank", "choices", "db_index", "default", "editable", "error_messages", "help_text", "validators"}
    | {"verbose_name"}
)


def applied_migrations(loader: MigrationLoader | None = None) -> list[list[str]]:
    """Returns the migrations of this database, in the form of a manifest."""
    applied = (loader or MigrationLoader(connection)).applied_migrations
    return sorted([app, name] for app, name in applied)


def require_readable(migrations: Any, made_by: object, left_out: frozenset[str]) -> bool:
    """Checks that the rows of a backup can be read with the tables of this version.

    Args:
        migrations: those of the backup's manifest.
        made_by: the version that made the backup.
        left_out: the tables that are in no backup.

    Returns whether the backup is of an earlier version.

    Raises:
        BackupError: the backup is of a later version, or of one that is too old.
    """
    loader = MigrationLoader(connection)
    ours = {(app, name) for app, name in applied_migrations(loader)}
    try:
        theirs = {(str(app), str(name)) for app, name in migrations}
    except (TypeError, ValueError) as error:
        raise BackupError("This is no backup of BT Studio: its manifest names no migrations.") from error
    if later := sorted(theirs - ours):
        raise BackupError(
            f"The backup was made by a later BT Studio ({made_by}), which has “{later[0][0]} {later[0][1]}”: "
            "restore it with that version."
        )
    added = sorted(ours - theirs)
    for app, name in added:
        before = loader.project_state((app, name), at_end=False)
        if not theirs or not _only_adds(app, loader.disk_migrations[app, name].operations, left_out, before):
            raise BackupError(
                f"The backup was made by BT Studio {made_by}, before “{app} {name}”, which changes data: "
                "restore it with that version, and upgrade then."
            )
    return bool(added)


def _only_adds(app: str, steps: Sequence[Operation], left_out: frozenset[str], before: ProjectState) -> bool:
    """Returns whether the steps of a migration need no look at the rows that are in backups.

    `before` are the tables without these steps.
    """
    if all(model._meta.label_lower in left_out for model in apps.get_app_config(app).get_models()):
        return True
    for step in steps:
        if not _is_harmless(app, step, before):
            return False
        step.state_forwards(app, before)
    return True


def _is_harmless(app: str, step: Operation, before: ProjectState) -> bool:
    match step:
        case operations.AddField():
            return _has_value(step)
        case operations.AlterField():
            model = before.models[app, step.model_name_lower]
            return _takes_all_values(step.field, model.fields[step.name])
        case _:
            return isinstance(step, _HARMLESS)


def _takes_all_values(field: Field[Any, Any], before: Field[Any, Any]) -> bool:
    """Returns whether the altered field takes all values of that before: it may allow null or be longer."""
    if (before.null and not field.null) or field.deconstruct()[1] != before.deconstruct()[1]:
        return False
    now, then = _facts(field), _facts(before)
    longest, was_longest = now.pop("max_length", None), then.pop("max_length", None)
    return now == then and (longest is None or (was_longest is not None and longest >= was_longest))


def _facts(field: Field[Any, Any]) -> dict[str, Any]:
    """Returns what decides which values a field takes, but for null."""
    return {name: fact for name, fact in field.deconstruct()[3].items() if name not in _OF_FORMS | {"null"}}


def _has_value(step: operations.AddField) -> bool:
    """Returns whether a row without the added field is complete."""
    field = step.field
    return field.many_to_many or field.null or (step.preserve_default and field.default is not NOT_PROVIDED)
