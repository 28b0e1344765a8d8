"""The results that each node of a project can return, found without running it (abstract interpretation)."""

from translator.check.results.interpret import Results, interpret

__all__ = ["Results", "interpret"]
