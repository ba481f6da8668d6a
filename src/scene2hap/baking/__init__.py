"""Design time: a scene in, a bundle out."""

from scene2hap.baking.scene import abake, arebake, bake, rebake
from scene2hap.baking.config import BakeConfig

__all__ = ["BakeConfig", "abake", "arebake", "bake", "rebake"]
