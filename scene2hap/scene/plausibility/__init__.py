"""Likely mistakes in a scene, such as sizes that cannot be metres."""
