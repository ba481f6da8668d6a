"""Spectra of sounds: their window, and their components."""
