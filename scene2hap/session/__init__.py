"""Play time: poses and touches in, vibration for every hand out."""

from scene2hap.session.config import SessionConfig
from scene2hap.session.frame import HapticFrame, SessionStats, Touch
from scene2hap.session.haptic_session import HapticSession
from scene2hap.session.impacts import Impact
from scene2hap.session.user_profile import UserProfile

__all__ = ["HapticFrame", "HapticSession", "Impact", "SessionConfig", "SessionStats", "Touch", "UserProfile"]
