"""Checks, files, keys and messages: what every layer uses, and what knows nothing of scenes or vibration."""
