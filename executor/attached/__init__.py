"""An attached session: another program's tree is followed by Groot2's protocol."""
