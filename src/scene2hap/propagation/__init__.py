"""How vibration spreads from its sources over touching objects to a hand."""

from scene2hap.plugins import PluginGroup

MODELS = PluginGroup(
    "scene2hap.propagation",
    builtins={
        "exponential_plate": "scene2hap.propagation.exponential_plate:ExponentialPlate",
        "no_propagation": "scene2hap.propagation.controls:NoPropagation",
        "full_propagation": "scene2hap.propagation.controls:FullPropagation",
    },
    extras={},
)
