"""Users without limits of places, for demonstrations.

A server of the release before, which may serve at the same time, writes no such column.
"""

from __future__ import annotations

from typing import ClassVar

from django.db import migrations, models


class Migration(migrations.Migration):
    dependencies: ClassVar = [("accounts", "0002_team")]

    operations: ClassVar = [
        migrations.AddField(
            model_name="user",
            name="is_exempt",
            field=models.BooleanField(
                db_default=False,
                default=False,
                help_text="Has no limit of robots, editors and tests at a time, and goes first when all "
                "places are taken. For a demonstration.",
                verbose_name="demonstration",
            ),
        )
    ]
