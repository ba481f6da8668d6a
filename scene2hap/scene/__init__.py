"""Scenes: typed snapshots, and how they are read from files and engines."""
