"""Settings from a TOML or JSON file."""

from scene2hap.settings import read_settings as read_settings
