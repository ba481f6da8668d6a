"""scene2hap: scene-wide vibrotactile haptics for virtual reality.

    scene = load_scene("kitchen.glb")
    bundle = bake(scene)
    session = HapticSession(scene, bundle)

Every public name below is imported at its first use. So ``import scene2hap`` takes almost no time, and a game imports
only the playing side.
"""

from __future__ import annotations

import sys
from importlib import import_module
from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"

_NAMES_IN = {
    "scene2hap.errors": ("UnknownMaterial",),
    "scene2hap.scene.load": ("load_scene",),
    "scene2hap.scene.capture": ("capture_images",),
    "scene2hap.scene.capture.given_pictures": ("GivenPictures",),
    "scene2hap.scene.images": ("ImageSet",),
    "scene2hap.scene.pose": ("Pose",),
    "scene2hap.scene.pose_table": ("PoseTable",),
    "scene2hap.scene.objects": ("Contact", "Hinge", "SceneObject"),
    "scene2hap.scene.surface.outline": ("Outline",),
    "scene2hap.scene.shapes": ("Box", "DominantSurface", "TriMesh"),
    "scene2hap.common.warning": ("SceneWarning",),
    "scene2hap.scene.snapshot": ("SceneSnapshot",),
    "scene2hap.materials": ("Material",),
    "scene2hap.haptics": ("ActuatorProfile", "Bands", "ObjectHaptics", "SourceState", "VibrationDescription"),
    "scene2hap.contact.graph": ("ContactChange", "ContactGraph"),
    "scene2hap.propagation.plate": ("Plate", "RigidBody"),
    "scene2hap.propagation.protocol": ("ContactNetwork", "Excitation", "PropagationField", "PropagationModel"),
    "scene2hap.propagation.exponential_plate": ("ExponentialPlate",),
    "scene2hap.propagation.infinite_plate": ("InfinitePlate",),
    "scene2hap.propagation.modal_plate": ("ModalPlate",),
    "scene2hap.propagation.auto": ("AutoFidelity",),
    "scene2hap.propagation.coupled.hand": ("Hand",),
    "scene2hap.propagation.modal.modes": ("PlateModes", "plate_modes"),
    "scene2hap.propagation.mass_spring_damper": ("MassSpringDamper",),
    "scene2hap.propagation.controls": ("FullPropagation", "NoPropagation"),
    "scene2hap.audio.clip": ("AudioClip", "Credit"),
    "scene2hap.audio.haptic_loop": ("HapticLoop",),
    "scene2hap.audio.protocol": ("AudioSource", "ConversionContext", "TactileConverter"),
    "scene2hap.audio.select": ("select_clip",),
    "scene2hap.llm.protocol": ("BackendWarning", "LLMBackend", "LLMReply", "LLMRequest"),
    "scene2hap.llm.lexicon": ("LexiconBackend",),
    "scene2hap.llm.backends.openai": ("OpenAIBackend",),
    "scene2hap.llm.backends.local": ("LocalBackend",),
    "scene2hap.llm.backends.function": ("FunctionBackend",),
    "scene2hap.llm.wrappers": (
        "BudgetBackend",
        "CacheBackend",
        "Price",
        "RepairBackend",
        "RetryBackend",
        "standard_stack",
    ),
    "scene2hap.llm.backends.replay": ("RecordingBackend", "ReplayBackend"),
    "scene2hap.llm.chain": ("infer_haptics",),
    "scene2hap.bundle": ("HapticBundle", "Override"),
    "scene2hap.baking": ("BakeConfig", "abake", "arebake", "bake", "bake_object", "rebake"),
    "scene2hap.session": ("HapticFrame", "HapticSession", "Impact", "SessionConfig", "Touch", "UserProfile"),
    "scene2hap.engines": ("EngineAdapter", "EngineLink", "MuJoCoLink", "Panda3DLink"),
    "scene2hap.baking.many": ("ManyReport", "abake_many", "bake_many"),
    "scene2hap.session.bundle_watch": ("BundleWatch",),
    "scene2hap.session.touch_track": ("TouchTrack",),
    "scene2hap.session.track_player": ("play_track",),
    "scene2hap.clips.haptic_clip": ("HapticClip",),
    "scene2hap.clips.reading": ("read_haptic_clip",),
    "scene2hap.export": ("export_bundle", "export_clip"),
    "scene2hap.devices.protocol": ("ActuatorSink", "SinkEvent", "SinkStats"),
    "scene2hap.devices.serial_amp": ("SerialAmplifierSink",),
    "scene2hap.devices.soundcard": ("SoundCardSink",),
    "scene2hap.devices.tee": ("TeeSink",),
    "scene2hap.devices.udp": ("UdpSink",),
    "scene2hap.devices.vhp_amp": ("VhpSink",),
    "scene2hap.devices.memory": ("MemorySink",),
    "scene2hap.devices.wav": ("WavSink",),
}
_MODULE_OF = {name: module for module, names in _NAMES_IN.items() for name in names}
# Those that need no extra, since help() and completion in notebooks import them all.
_PACKAGES = (
    "audio",
    "baking",
    "bundle",
    "clips",
    "contact",
    "demo",
    "devices",
    "engines",
    "errors",
    "export",
    "haptics",
    "llm",
    "materials",
    "propagation",
    "render",
    "report",
    "scene",
    "session",
    "testing",
)

if not TYPE_CHECKING:  # type checkers would take any name for one of ours, and do not compute `__all__`
    __all__ = ["__version__", *sorted(_MODULE_OF)]

    def __getattr__(name: str) -> Any:
        if name in _MODULE_OF:
            value = getattr(import_module(_MODULE_OF[name]), name)
            globals()[name] = value
            return value
        if name in _PACKAGES:
            return import_module(f"scene2hap.{name}")
        from importlib.util import find_spec

        if name.startswith("_") or find_spec(f"{__name__}.{name}") is not None:  # a submodule that is being imported
            raise AttributeError(f"module 'scene2hap' has no attribute {name!r}")
        from scene2hap import errors
        from scene2hap.common.calls import unknown_attribute, unknown_import

        known = [f"errors.{name}"] if hasattr(errors, name) else [one for one in __dir__() if not one.startswith("_")]
        # `from scene2hap import name` looks the name up first, and replaces an AttributeError by a message of its own.
        is_import = sys._getframe(1).f_code.co_name == "_handle_fromlist"
        raise (unknown_import if is_import else unknown_attribute)("scene2hap", name, known)


def __dir__() -> list[str]:
    return sorted({*_MODULE_OF, *_PACKAGES, *(name for name in globals() if name.startswith("__"))})


if TYPE_CHECKING:
    from scene2hap import (
        audio as audio,
        baking as baking,
        bundle as bundle,
        clips as clips,
        contact as contact,
        demo as demo,
        devices as devices,
        engines as engines,
        errors as errors,
        export as export,
        haptics as haptics,
        llm as llm,
        materials as materials,
        propagation as propagation,
        render as render,
        report as report,
        scene as scene,
        session as session,
        testing as testing,
    )
    from scene2hap.audio.clip import AudioClip as AudioClip, Credit as Credit
    from scene2hap.audio.haptic_loop import HapticLoop as HapticLoop
    from scene2hap.audio.protocol import (
        AudioSource as AudioSource,
        ConversionContext as ConversionContext,
        TactileConverter as TactileConverter,
    )
    from scene2hap.audio.select import select_clip as select_clip
    from scene2hap.baking import (
        BakeConfig as BakeConfig,
        abake as abake,
        arebake as arebake,
        bake as bake,
        bake_object as bake_object,
        rebake as rebake,
    )
    from scene2hap.baking.many import ManyReport as ManyReport, abake_many as abake_many, bake_many as bake_many
    from scene2hap.bundle import HapticBundle as HapticBundle, Override as Override
    from scene2hap.clips.haptic_clip import HapticClip as HapticClip
    from scene2hap.clips.reading import read_haptic_clip as read_haptic_clip
    from scene2hap.common.warning import SceneWarning as SceneWarning
    from scene2hap.contact.graph import ContactChange as ContactChange, ContactGraph as ContactGraph
    from scene2hap.devices.memory import MemorySink as MemorySink
    from scene2hap.devices.protocol import ActuatorSink as ActuatorSink, SinkEvent as SinkEvent, SinkStats as SinkStats
    from scene2hap.devices.serial_amp import SerialAmplifierSink as SerialAmplifierSink
    from scene2hap.devices.soundcard import SoundCardSink as SoundCardSink
    from scene2hap.devices.tee import TeeSink as TeeSink
    from scene2hap.devices.udp import UdpSink as UdpSink
    from scene2hap.devices.vhp_amp import VhpSink as VhpSink
    from scene2hap.devices.wav import WavSink as WavSink
    from scene2hap.engines import (
        EngineAdapter as EngineAdapter,
        EngineLink as EngineLink,
        MuJoCoLink as MuJoCoLink,
        Panda3DLink as Panda3DLink,
    )
    from scene2hap.errors import UnknownMaterial as UnknownMaterial
    from scene2hap.export import export_bundle as export_bundle, export_clip as export_clip
    from scene2hap.haptics import (
        ActuatorProfile as ActuatorProfile,
        Bands as Bands,
        ObjectHaptics as ObjectHaptics,
        SourceState as SourceState,
        VibrationDescription as VibrationDescription,
    )
    from scene2hap.llm.backends.function import FunctionBackend as FunctionBackend
    from scene2hap.llm.backends.local import LocalBackend as LocalBackend
    from scene2hap.llm.backends.openai import OpenAIBackend as OpenAIBackend
    from scene2hap.llm.backends.replay import RecordingBackend as RecordingBackend, ReplayBackend as ReplayBackend
    from scene2hap.llm.chain import infer_haptics as infer_haptics
    from scene2hap.llm.lexicon import LexiconBackend as LexiconBackend
    from scene2hap.llm.protocol import (
        BackendWarning as BackendWarning,
        LLMBackend as LLMBackend,
        LLMReply as LLMReply,
        LLMRequest as LLMRequest,
    )
    from scene2hap.llm.wrappers import (
        BudgetBackend as BudgetBackend,
        CacheBackend as CacheBackend,
        Price as Price,
        RepairBackend as RepairBackend,
        RetryBackend as RetryBackend,
        standard_stack as standard_stack,
    )
    from scene2hap.materials import Material as Material
    from scene2hap.propagation.auto import AutoFidelity as AutoFidelity
    from scene2hap.propagation.controls import FullPropagation as FullPropagation, NoPropagation as NoPropagation
    from scene2hap.propagation.coupled.hand import Hand as Hand
    from scene2hap.propagation.exponential_plate import ExponentialPlate as ExponentialPlate
    from scene2hap.propagation.infinite_plate import InfinitePlate as InfinitePlate
    from scene2hap.propagation.mass_spring_damper import MassSpringDamper as MassSpringDamper
    from scene2hap.propagation.modal.modes import PlateModes as PlateModes, plate_modes as plate_modes
    from scene2hap.propagation.modal_plate import ModalPlate as ModalPlate
    from scene2hap.propagation.plate import Plate as Plate, RigidBody as RigidBody
    from scene2hap.propagation.protocol import (
        ContactNetwork as ContactNetwork,
        Excitation as Excitation,
        PropagationField as PropagationField,
        PropagationModel as PropagationModel,
    )
    from scene2hap.scene.capture import capture_images as capture_images
    from scene2hap.scene.capture.given_pictures import GivenPictures as GivenPictures
    from scene2hap.scene.images import ImageSet as ImageSet
    from scene2hap.scene.load import load_scene as load_scene
    from scene2hap.scene.objects import Contact as Contact, Hinge as Hinge, SceneObject as SceneObject
    from scene2hap.scene.pose import Pose as Pose
    from scene2hap.scene.pose_table import PoseTable as PoseTable
    from scene2hap.scene.shapes import Box as Box, DominantSurface as DominantSurface, TriMesh as TriMesh
    from scene2hap.scene.snapshot import SceneSnapshot as SceneSnapshot
    from scene2hap.scene.surface.outline import Outline as Outline
    from scene2hap.session import (
        HapticFrame as HapticFrame,
        HapticSession as HapticSession,
        Impact as Impact,
        SessionConfig as SessionConfig,
        Touch as Touch,
        UserProfile as UserProfile,
    )
    from scene2hap.session.bundle_watch import BundleWatch as BundleWatch
    from scene2hap.session.touch_track import TouchTrack as TouchTrack
    from scene2hap.session.track_player import play_track as play_track
