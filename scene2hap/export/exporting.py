"""Exports of a bundle, of a hand's tour through it, or of one clip, into a folder.

FOLDER/manifest.json      the data with which an engine places the files
FOLDER/report.json, .txt  the error of each file against its signal
FOLDER/KIND/NAME.*        the files of each track in each format
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from scene2hap.audio.files import read_channels
from scene2hap.audio.loop_marks import marked_loop
from scene2hap.bundle import HapticBundle
from scene2hap.bundle.sounds import file_stem, file_stems
from scene2hap.clips.reading import is_haptic_clip, read_haptic_clip
from scene2hap.clips.synthesis import RATE_HZ, synthesize
from scene2hap.common import checks
from scene2hap.common.arrays import Floats
from scene2hap.common.calls import clear_call
from scene2hap.devices.memory import MemorySink
from scene2hap.errors import ConfigError, ExportError
from scene2hap.export.export_folder import REPORT, Progress, checked_folder, write_tracks
from scene2hap.export.manifest import NAME, manifest_of
from scene2hap.export.protocol import EXPORTS, Exporter, json_bytes
from scene2hap.export.report import ExportReport
from scene2hap.export.track import Channel, Track
from scene2hap.session import HapticSession, SessionConfig
from scene2hap.session.touch_track import TouchTrack
from scene2hap.session.track_player import play_track

ALL = "all"
_BLOCK_S = 0.05
"""Length of the blocks whose means are compared, to find an offset [s]: one cycle at 20 Hz."""
_CHANNEL_NAMES = {1: [""], 2: ["left", "right"]}
Kinds = str | Mapping[str, Any] | Exporter | Sequence[str | Mapping[str, Any] | Exporter]


@clear_call
def export_bundle(
    bundle: HapticBundle,
    folder: str | os.PathLike[str],
    to: Kinds = ALL,
    *,
    touches: TouchTrack | str | os.PathLike[str] | None = None,
    config: SessionConfig | Mapping[str, Any] | None = None,
    update_rate_hz: float = 100.0,
    progress: Progress | None = None,
) -> ExportReport:
    """Write every state of every source, and with `touches` every hand over time, in one or more formats.

    Parameters: to : a kind, a mapping of a kind and its settings, an exporter, or several of these; "all" for every
        known kind; touches : a track, or its file; config : of the session that plays it; progress : called with stage,
        step, number done and total number.
    Returns: the written files, with the error of each.
    Raises: ConfigError: an unknown kind or setting; SessionError: touches that cannot be played; ExportError: the
    folder cannot be written, is a bundle, or holds a manifest.json or report.json of another program. No file is
    replaced before all are written; the manifest is replaced last. Then files of these kinds are removed that an
    earlier manifest of this scene lists for a source, and the new one does not.
    Warns: SceneWarning: files of other kinds or of another scene stay, and the new manifest does not list them.
    """
    exporters, folder = _exporters(to), checked_folder(folder, NAME, REPORT)
    if not isinstance(bundle, HapticBundle):
        raise ExportError(
            f"bundle is {checks.described(bundle)}; it must be a HapticBundle, as HapticBundle.load(folder) reads."
        )
    tracks: dict[str, Track] = {}
    names: dict[str, tuple[str, str]] = {}
    sources = file_stems(bundle.loops)
    for source, states in bundle.loops.items():
        stems = file_stems(states)
        for state, loop in states.items():
            name = f"{sources[source]}.{stems[state]}"
            names[name] = source, state
            channel = Channel(np.asarray(loop.tactile.samples), loop.tactile.sample_rate_hz, is_loop=True)
            tracks[name] = Track(name, {"": channel})
    tours = {}
    if touches is not None:
        tour = _tour(bundle, touches, config, update_rate_hz)
        tracks[tour.name], tours[tour.name] = tour, tour.duration_s
    settings = SessionConfig.parse(config)

    def manifest(report: ExportReport) -> bytes:
        found = manifest_of(bundle, report, names, tours, settings.propagation)
        return json_bytes(found.model_dump(mode="json"))

    return write_tracks(list(tracks.values()), exporters, folder, manifest, progress)


@clear_call
def export_clip(
    path: str | os.PathLike[str], folder: str | os.PathLike[str], to: Kinds = ALL, *, progress: Progress | None = None
) -> ExportReport:
    """Write one haptic clip (.haptic, .ahap) or one sound file in other formats. The curves of a clip are unchanged.

    A sound file is taken as a vibration, as `convert` and `render` write it. Two channels are the left and the right
    hand, more are "channel_1" and so on. A file that peaks above full scale is scaled down to it. A constant offset is
    removed. A WAV that marks all of itself as a loop, as those of a bundle do, is written as a loop.

    Raises: AudioError, ClipError: the file cannot be read; and as `export_bundle`.
    """
    path = checks.path("path", path, error=ExportError)
    exporters, folder = _exporters(to), checked_folder(folder, REPORT)
    if is_haptic_clip(path):
        clip = read_haptic_clip(path)
        channels = {"": Channel(np.clip(synthesize(clip), -1.0, 1.0), RATE_HZ, clip=clip)}
    else:
        read, rate = read_channels(path)
        samples = _without_offset(read.astype(np.float64), rate)
        samples = samples / max(1.0, float(np.abs(samples).max()))  # one factor: clipping would distort
        names = _CHANNEL_NAMES.get(samples.shape[1], [f"channel_{i + 1}" for i in range(samples.shape[1])])
        is_loop = marked_loop(path, len(samples), rate) == (0, len(samples))
        channels = {name: Channel(one, rate, is_loop) for name, one in zip(names, samples.T, strict=True)}
    track = Track(file_stem(path.stem), channels)
    return write_tracks([track], exporters, folder, None, progress)


def _without_offset(samples: Floats, rate_hz: float) -> Floats:
    """Subtract the constant offset of each channel (n, n_channels), such as that of a cheap recorder.

    No actuator plays it, and an envelope would show it as vibration. It must hold throughout the file: in a file of
    pulses in one direction with silence between them, the mean is no offset.
    """
    block = max(1, min(len(samples), round(_BLOCK_S * rate_hz)))
    blocks = samples[: len(samples) // block * block].reshape(-1, block, samples.shape[1]).mean(axis=1)
    offset = np.median(blocks, axis=0)
    holds = np.percentile(blocks * np.sign(offset), 5, axis=0) >= np.abs(offset) / 2
    return np.where(holds, samples - offset, samples)


def _exporters(to: Kinds) -> dict[str, Exporter]:
    """Return exporters by the names of their folders. Raises: ConfigError."""
    if isinstance(to, os.PathLike):
        raise ConfigError(f"to is a path, {checks.represented(str(to))}; it names kinds, as 'wav'. Give it as folder=.")
    if isinstance(to, str | Mapping) or not isinstance(to, Sequence):
        to = [to]
    wanted: list[Any] = [kind for one in to for kind in (EXPORTS.kinds() if one == ALL else [one])]
    if not wanted:
        raise ConfigError(f"to is {checks.represented(to)}; it must name a kind: {', '.join(EXPORTS.kinds())}, or all.")
    found: dict[str, Exporter] = {}
    for spec in wanted:
        exporter: Any = EXPORTS.build(spec)
        kind = spec if isinstance(spec, str) else spec.get("kind") if isinstance(spec, Mapping) else type(spec).__name__
        name = str(kind)
        while name in found:  # the same kind with other settings
            name += "_2"
        found[name] = exporter
    return found


def _tour(
    bundle: HapticBundle,
    touches: TouchTrack | str | os.PathLike[str],
    config: SessionConfig | Mapping[str, Any] | None,
    update_rate_hz: float,
) -> Track:
    track = touches if isinstance(touches, TouchTrack) else TouchTrack.load(touches)
    name = "tour" if isinstance(touches, TouchTrack) else file_stem(Path(touches).stem)
    sink = MemorySink()
    settings = SessionConfig.parse(config, prepare="blocking")
    with HapticSession(bundle, config=settings, sink=sink) as session:
        play_track(session, track, sink, update_rate_hz=update_rate_hz)
        hands, rate = session.hands, settings.sample_rate_hz
        # Leaving the session fades out. The tour ends before that.
        samples = sink.samples[: round(track.duration_s * rate)].astype(np.float64)
    return Track(name, {hand: Channel(samples[:, i], rate) for i, hand in enumerate(hands)})
