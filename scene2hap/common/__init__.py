"""Checks, files, keys and messages for every layer, independent of scenes and vibration."""
