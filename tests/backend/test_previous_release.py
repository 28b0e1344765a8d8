"""The release before: it serves on with the tables of this one, and its data and backups are opened here.

`HEADS` are the migrations of that release, and `previous_release.zip` is a backup that it wrote; both change
with each release. Its code is not in a clone without history. What it asks of the database is: its models are
those of its migrations.
"""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any, Final

import pytest
from django.apps import apps
from django.db import connection, models
from django.db.migrations.executor import MigrationExecutor
from django.db.migrations.operations import AlterField
from django.utils import timezone

from backend.accounts.writes import local_user
from backend.cli.shared.backup_file import read_backup
from backend.projects.models import ChangeSet, Project

HEADS: Final = [
    ("accounts", "0002_team"),
    ("evaluations", "0003_line_bytes"),
    ("executor_sessions", "0008_warm"),
    ("projects", "0002_team"),
    ("runs", "0002_last"),
]
OWN: Final = tuple(app for app, _ in HEADS)
BACKUP: Final = Path(__file__).with_name("previous_release.zip")


def migrate(targets: list[tuple[str, str]]) -> Any:
    """Brings the tables of our apps to these migrations; returns the models that belong to them."""
    executor = MigrationExecutor(connection)
    executor.migrate(targets)
    return executor.loader.project_state(targets).apps


def newest() -> list[tuple[str, str]]:
    """The last migrations of our apps."""
    return [node for node in MigrationExecutor(connection).loader.graph.leaf_nodes() if node[0] in OWN]


def fill(old: Any) -> dict[str, Any]:
    """Writes one row of each table, as the release before does; returns their keys."""
    made: dict[str, Any] = {}
    waiting = [model for app in OWN for model in old.get_app_config(app).get_models()]
    while waiting:
        model = waiting.pop(0)
        needed = {field.related_model._meta.label_lower for field in foreign(model)}
        if needed - made.keys() - {model._meta.label_lower}:
            waiting.append(model)
        else:
            made[model._meta.label_lower] = model._base_manager.create(**values(model, made)).pk
    return made


def foreign(model: Any) -> list[Any]:
    """The fields of a model that refer to other rows."""
    return [field for field in model._meta.concrete_fields if field.remote_field is not None]


def values(model: Any, made: dict[str, Any]) -> dict[str, Any]:
    """A value for each field of a new row that has no default."""
    found: dict[str, Any] = {}
    for field in model._meta.concrete_fields:
        if field.remote_field is not None:
            if field.related_model._meta.label_lower in made:
                found[field.attname] = made[field.related_model._meta.label_lower]
        elif not (field.null or field.has_default() or isinstance(field, models.AutoField)):
            found[field.attname] = value(field)
    return found


def value(field: Any) -> Any:
    """A value of a field's type, which no other row has."""
    if field.choices:
        return field.choices[0][0]
    if isinstance(field, models.DateTimeField):
        return timezone.now()
    if isinstance(field, models.BinaryField):
        return b"bytes"
    if isinstance(field, models.IntegerField | models.FloatField):
        return timezone.now().microsecond % 30_000 + 1
    return f"v{timezone.now().microsecond}"[: field.max_length]


@pytest.mark.django_db(transaction=True)
def test_the_release_before_writes_reads_changes_and_deletes_meanwhile():
    now = newest()
    try:
        old = migrate(HEADS)
        first = fill(old)
        migrate(now)
        for label, key in first.items():
            assert old.get_model(label)._base_manager.filter(pk=key).count() == 1, label
            assert apps.get_model(label)._base_manager.get(pk=key).pk == key
        second = fill(old)
        for label, key in reversed(second.items()):
            row = old.get_model(label)._base_manager.get(pk=key)
            row.save()
            assert apps.get_model(label)._base_manager.get(pk=key).pk == key
        for label, key in reversed(second.items()):
            assert old.get_model(label)._base_manager.filter(pk=key).delete()[0] >= 1, label
    finally:
        migrate(now)


@pytest.mark.django_db
def test_no_column_changes_its_type():
    """PostgreSQL refuses what the release before has prepared, as long as its connections last."""
    executor = MigrationExecutor(connection)
    known = set(executor.loader.graph.nodes) & {
        node for head in HEADS for node in executor.loader.graph.forwards_plan(head)
    }
    added = [node for head in newest() for node in executor.loader.graph.forwards_plan(head)]
    state = executor.loader.project_state(HEADS)
    for node in dict.fromkeys(added):
        if node in known or node[0] not in OWN:
            continue
        migration = executor.loader.get_migration(*node)
        for step in migration.operations:
            before = state.clone()
            step.state_forwards(node[0], state)
            if isinstance(step, AlterField):
                models_of = (before.apps, state.apps)
                fields = [
                    apps.get_model(node[0], step.model_name)._meta.get_field(step.name) for apps in models_of
                ]
                old, new = (field.db_parameters(connection)["type"] for field in fields)
                assert old == new, f"{node}: {step.describe()}"


@pytest.mark.django_db(transaction=True)
def test_a_backup_of_the_release_before_is_restored():
    counts = read_backup(io.BytesIO(BACKUP.read_bytes()))
    assert counts["projects.project"] == Project.objects.count() > 0
    assert counts["projects.changeset"] == ChangeSet.objects.count() > counts["projects.project"]
    assert local_user().pk
