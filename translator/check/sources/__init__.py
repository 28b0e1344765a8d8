"""Checks of users' Python before it runs: names, imports, and the methods that the engine calls."""

from translator.check.sources.run import check_sources, source_findings

__all__ = ["check_sources", "source_findings"]
