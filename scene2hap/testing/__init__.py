"""Contracts for parts of other packages: functions that raise AssertionError if a part breaks its protocol.

They need no pytest; call them in your own tests. The tests of scene2hap check its parts with the same functions.
"""

from scene2hap.testing.actuator_sink import check_actuator_sink
from scene2hap.testing.audio_source import check_audio_source
from scene2hap.testing.bridge_client import ClientCheck, check_bridge_client
from scene2hap.testing.engine_adapter import check_engine_adapter
from scene2hap.testing.exporter import check_exporter
from scene2hap.testing.llm_backend import check_llm_backend
from scene2hap.testing.propagation_model import check_propagation_model
from scene2hap.testing.renderer import check_renderer
from scene2hap.testing.tactile_converter import check_tactile_converter

__all__ = [
    "ClientCheck",
    "check_actuator_sink",
    "check_audio_source",
    "check_bridge_client",
    "check_engine_adapter",
    "check_exporter",
    "check_llm_backend",
    "check_propagation_model",
    "check_renderer",
    "check_tactile_converter",
]
