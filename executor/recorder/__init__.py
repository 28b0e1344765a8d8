"""Recordings of runs: MCAP files in the profile `ros2`, with all message definitions in the file."""
