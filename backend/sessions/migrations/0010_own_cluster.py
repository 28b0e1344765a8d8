"""Whether an evaluation has a Ray cluster of its own."""

from __future__ import annotations

from django.db import migrations, models


class Migration(migrations.Migration):
    dependencies = [("executor_sessions", "0009_host")]

    # The release before does not write it: the database does, as long as both serve.
    operations = [
        migrations.AddField(
            model_name="session",
            name="own_cluster",
            field=models.BooleanField(db_default=False, default=False),
        ),
    ]
