"""Checks of projects: every rule of BehaviorTree.CPP's loader, and more, applied before the tree runs."""

from translator.check.run import check

__all__ = ["check"]
