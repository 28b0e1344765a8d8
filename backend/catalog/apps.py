"""Django's entry of this app."""

from django.apps import AppConfig


class CatalogConfig(AppConfig):
    """Catalog."""

    name = "backend.catalog"
    label = "catalog"
