"""Haptic clips: vibration as envelopes over time, and the files that hold them."""
