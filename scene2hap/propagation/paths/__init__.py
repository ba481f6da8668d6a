"""Cheapest paths over contacts, by which the paper's law attenuates: over a prepared scene, or one that changes."""
