"""Which backups of other versions can be read."""

from __future__ import annotations

import pytest
from django.db import connection, migrations, models
from django.db.migrations.loader import MigrationLoader

from backend.cli.shared.backup_age import _only_adds, applied_migrations, require_readable
from backend.cli.shared.backup_error import BackupError
from backend.cli.shared.backup_file import LEFT_OUT

pytestmark = pytest.mark.django_db


def test_one_of_this_version_and_of_the_one_before_are_read():
    ours = applied_migrations()
    assert not require_readable(ours, "0.1.0", LEFT_OUT)
    before = [each for each in ours if each != ["projects", "0003_object_store"]]
    assert require_readable(before, "0.1.0", LEFT_OUT)


def test_one_of_a_later_version_is_refused():
    with pytest.raises(BackupError, match=r"later BT Studio \(9\).*projects 0099_more"):
        require_readable([*applied_migrations(), ["projects", "0099_more"]], "9", LEFT_OUT)


@pytest.mark.parametrize("nonsense", [None, 3, [1], "text", [["a", "b", "c"]]])
def test_a_manifest_without_migrations_is_refused(nonsense):
    with pytest.raises(BackupError):
        require_readable(nonsense, None, LEFT_OUT)


@pytest.mark.parametrize(
    ("step", "is_harmless"),
    [
        (migrations.AddField("blob", "new", models.IntegerField(null=True)), True),
        (migrations.AddField("blob", "new", models.IntegerField(default=1)), True),
        (migrations.AddField("blob", "new", models.IntegerField(default=1), preserve_default=False), False),
        (migrations.RunPython(migrations.RunPython.noop), False),
        (migrations.RemoveField("blob", "data"), False),
        (migrations.AlterField("blob", "stored_at", models.CharField(max_length=300, null=True)), True),
        (
            migrations.AlterField(
                "blob", "stored_at", models.CharField(max_length=200, null=True, blank=True)
            ),
            True,
        ),
        (migrations.AlterField("blob", "stored_at", models.CharField(max_length=100, null=True)), False),
        (migrations.AlterField("blob", "stored_at", models.CharField(max_length=200)), False),
        (
            migrations.AlterField(
                "blob", "stored_at", models.CharField(max_length=200, null=True, unique=True)
            ),
            False,
        ),
        (migrations.AlterField("blob", "stored_at", models.DateTimeField(null=True)), False),
    ],
)
def test_steps_that_need_the_rows_are_refused(step, is_harmless):
    before = MigrationLoader(connection).project_state()
    assert _only_adds("projects", [step], LEFT_OUT, before) is is_harmless
    assert _only_adds("executor_sessions", [step], LEFT_OUT, before)  # nothing of it is in a backup
