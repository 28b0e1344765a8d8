"""The lease of the web server that works for all."""

from __future__ import annotations

from django.db import migrations, models


class Migration(migrations.Migration):
    dependencies = [("executor_sessions", "0003_drain")]

    operations = [
        migrations.CreateModel(
            name="Lease",
            fields=[
                ("name", models.CharField(max_length=40, primary_key=True, serialize=False)),
                ("owner", models.CharField(max_length=100)),
                ("until", models.DateTimeField()),
            ],
        ),
    ]
