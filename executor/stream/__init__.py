"""What goes over the stream socket, and what waits to."""
