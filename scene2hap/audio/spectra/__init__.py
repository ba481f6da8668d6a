"""Spectra of sounds: their window, their components, and their audible part."""
