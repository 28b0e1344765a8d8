"""The language server's messages: their framing, their addresses, and what they become for the page."""
