"""The error of backups."""


class BackupError(Exception):
    """The backup cannot be read, or not into this database; the text tells the reason and what to do."""
