"""Filters between subscriptions and callbacks, which combine messages that belong together."""

from message_filters.cache import Cache
from message_filters.simple import SimpleFilter, Subscriber
from message_filters.synchronizers import ApproximateTimeSynchronizer, TimeSynchronizer

__all__ = ["ApproximateTimeSynchronizer", "Cache", "SimpleFilter", "Subscriber", "TimeSynchronizer"]
