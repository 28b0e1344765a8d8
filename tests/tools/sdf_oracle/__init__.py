"""Compares the poses that we read from SDF with those of libsdformat."""
