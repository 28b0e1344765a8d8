from django.db import migrations, models


class Migration(migrations.Migration):
    dependencies = [
        ("evaluations", "0003_line_bytes"),
    ]

    operations = [
        migrations.AddField(
            model_name="evaluation",
            name="notes",
            field=models.TextField(blank=True, default="", db_default=""),
        ),
    ]
