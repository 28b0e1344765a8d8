"""Django's entry of this app."""

from django.apps import AppConfig


class CatalogConfig(AppConfig):
    """Configuration of the app of the catalogue."""

    name = "backend.catalog"
    label = "catalog"
