"""Looks of objects: colours and textures of their faces, which only pictures use."""
