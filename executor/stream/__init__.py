"""Frames of the stream socket: encoding and queues."""
