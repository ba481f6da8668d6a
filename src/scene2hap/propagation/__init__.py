"""How vibration spreads from its sources over touching objects to a hand."""

from scene2hap.plugins import PluginGroup

MODELS = PluginGroup(
    "scene2hap.propagation",
    builtins={
        "exponential_plate": "scene2hap.propagation.exponential_plate:ExponentialPlate",
        "infinite_plate": "scene2hap.propagation.infinite_plate:InfinitePlate",
        "modal_plate": "scene2hap.propagation.modal_plate:ModalPlate",
        "mass_spring_damper": "scene2hap.propagation.mass_spring_damper:MassSpringDamper",
        "auto": "scene2hap.propagation.auto:AutoFidelity",
        "no_propagation": "scene2hap.propagation.controls:NoPropagation",
        "full_propagation": "scene2hap.propagation.controls:FullPropagation",
    },
    extras={},
)
