"""Propagation models: how vibration spreads from its sources over touching objects to a hand."""

from typing import TYPE_CHECKING, Any

from scene2hap.plugins import PluginGroup

if TYPE_CHECKING:
    from scene2hap.propagation.plots import plot_field as plot_field

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
    members={"prepare": ("network", "excitations", "bands")},
    # The paper's words for its conditions; "full" is near enough to be found without.
    synonyms={"none": ("no_propagation",), "attenuated": ("exponential_plate",), "paper": ("exponential_plate",)},
)


def __getattr__(name: str) -> Any:
    if name == "plot_field":  # imported when it is first used: it needs the extra `plots`
        from scene2hap.propagation.plots import plot_field

        return plot_field
    raise AttributeError(f"module 'scene2hap.propagation' has no attribute {name!r}")
