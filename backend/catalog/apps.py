"""The configuration of this Django app."""

from django.apps import AppConfig


class CatalogConfig(AppConfig):
    """Configuration of the app of the catalogue."""

    name = "backend.catalog"
    label = "catalog"
