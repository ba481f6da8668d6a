"""Habitat scenes: the scene, its dataset of templates, and names of templates."""
