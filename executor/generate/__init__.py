"""Writes what follows from the code: TypeScript types, the page of the protocol, pictures."""
