"""Gains of every hand from its touches, without sources too weak to be felt."""
