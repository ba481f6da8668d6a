"""Baking: inference, sounds and loops at design time, from a scene to a bundle."""

from scene2hap.baking.config import BakeConfig
from scene2hap.baking.scene import abake, arebake, bake, bake_object, rebake
from scene2hap.bundle import BundleWarning

__all__ = ["BakeConfig", "BundleWarning", "abake", "arebake", "bake", "bake_object", "rebake"]
