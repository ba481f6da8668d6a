"""Explanations of what each hand of a session feels, with every part of it that has a say."""

from __future__ import annotations

from dataclasses import replace

from scene2hap.session.explanation.explainer import Explainer
from scene2hap.session.explanation.report import Explanation, FeltSource
from scene2hap.session.gains.hand_frames import HandFrames
from scene2hap.session.impacts.felt_impacts import Impacts
from scene2hap.session.mix.output import Output
from scene2hap.session.mix.playback import Playback
from scene2hap.session.mix.sources import Sources
from scene2hap.session.mix.starts_and_stops import Switching
from scene2hap.session.present_scene.scene_state import SceneState


class Explanations:
    """Adds to the gains of a hand what else it feels, or keeps it from feeling: starts and stops, impacts, the sink.

    Parameters: model : of propagation, in use.
    """

    def __init__(
        self,
        model: object,
        state: SceneState,
        sources: Sources,
        switching: Switching,
        hand_frames: HandFrames,
        playback: Playback,
        impacts: Impacts,
        output: Output,
    ) -> None:
        self._model, self._state, self._sources, self._switching = model, state, sources, switching
        self._hand_frames, self._playback, self._impacts, self._output = hand_frames, playback, impacts, output

    def of(self, hand: str) -> Explanation:
        """Explain what a hand feels; see `HapticSession.explain`."""
        explainer = Explainer(self._state, self._sources, self._model, self._hand_frames.last(hand))
        explained = explainer.explain(is_paused=self._playback.is_paused)
        felt = sorted(
            map(self._with_running, explained.felt), key=lambda one: -(one.gain_db + one.level_db + one.running_db)
        )
        of_sink = self._output.why_silent
        reasons = explained.reasons if of_sink is None else (of_sink, *explained.reasons)
        return replace(explained, felt=tuple(felt), impacts=self._impacts.felt_by(hand), reasons=reasons)

    def _with_running(self, felt: FeltSource) -> FeltSource:
        """Add the amplitude of a start or stop that is under way."""
        source = self._sources[felt.source_id]
        if source.transition_row is None:
            return felt
        amplitude = self._switching.running(felt.source_id).amplitude
        return felt.during_transition(amplitude, is_start=source.is_running)
