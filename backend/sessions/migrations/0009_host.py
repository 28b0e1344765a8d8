"""The host on which an executor runs."""

from __future__ import annotations

from django.db import migrations, models


class Migration(migrations.Migration):
    dependencies = [("executor_sessions", "0008_warm")]

    # The release before writes no host: the database does, as long as both serve. Addresses keep their length:
    # PostgreSQL refuses statements that servers have prepared when the type of a column changes.
    operations = [
        migrations.AddField(
            model_name="session",
            name="host",
            field=models.CharField(blank=True, db_default="", default="", max_length=270),
        ),
    ]
