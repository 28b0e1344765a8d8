"""Exceptions of tf2."""


class TransformException(Exception):  # noqa: N818 - its name in tf2
    """Base of all exceptions of tf2."""


class ConnectivityException(TransformException):
    """Both frames exist, but they are not connected."""


class LookupException(TransformException):
    """A frame does not exist."""


class ExtrapolationException(TransformException):
    """The time is outside of the stored samples."""


class InvalidArgumentException(TransformException):
    """The name of a frame is invalid."""


class TimeoutException(TransformException):
    """No transform was found before the timeout."""
