"""Scenes: typed snapshots, and readers of files and engines."""
