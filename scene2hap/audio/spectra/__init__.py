"""Spectra of sounds: their window, their components, and what of them is heard."""
