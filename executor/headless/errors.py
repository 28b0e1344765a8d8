"""Why a run without a browser cannot be done."""


class HeadlessError(Exception):
    """The run cannot be done as asked; the text says why."""
