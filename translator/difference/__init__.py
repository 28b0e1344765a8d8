"""Compares two versions of a tree or of a project, by their nodes instead of their lines."""

from translator.difference.operations import Operation, compare
from translator.difference.shape import Document, Shape

__all__ = ["Document", "Operation", "Shape", "compare"]
