"""Rendering of gains to samples: loops, gain ramps, the mix and its limiter."""
