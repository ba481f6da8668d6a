"""Gains of bands: the frequencies at which a scene is solved, and the root mean square over each band."""
