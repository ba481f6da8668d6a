"""Playback of a baked scene: takes poses and touches, and renders the vibration of every hand."""

from scene2hap.session.config import SessionConfig
from scene2hap.session.frame import HapticFrame, Touch
from scene2hap.session.haptic_session import HapticSession
from scene2hap.session.impacts.felt_impacts import Impact
from scene2hap.session.stats import SessionStats
from scene2hap.session.user_profile import UserProfile

__all__ = ["HapticFrame", "HapticSession", "Impact", "SessionConfig", "SessionStats", "Touch", "UserProfile"]
