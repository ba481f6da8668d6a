"""The contact graph: which objects touch, and where, updated as they move."""
