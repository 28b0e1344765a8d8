"""The object store: a bucket for contents that would be large in the database."""
