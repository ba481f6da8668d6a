"""Figures of sounds and loops: waveform, spectrogram, and the spectrum beside the threshold of touch.

These functions take plain samples, so that the classes of sounds can call them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from scene2hap.audio.spectra.windows import hann
from scene2hap.audio.threshold import TACTILE_RANGE_HZ, threshold_db
from scene2hap.common.arrays import Floats, Floats32
from scene2hap.common.plots import SOUND, THRESHOLD, TOUCH, add_legend, new_figure, plain, set_title

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure, SubFigure

Samples = Floats32

RANGE_DB = 60.0
"""Dynamic range of colours and spectra below their maximum [dB]; full scale is 45 dB over the threshold of touch."""
_COLUMNS = 1500
"""Points of a waveform or spectrum: more than a page can show, and few enough to draw fast."""
_FRAMES, _ROWS = 300, 160
_WINDOW_S = 0.1


def plot_clip(
    samples: Samples, sample_rate_hz: int, title: str, *, is_felt: bool, figure: Figure | SubFigure | None
) -> Figure | SubFigure:
    """Draw waveform, spectrogram, and spectrum with the threshold of touch. See `AudioClip.plot`."""
    figure = new_figure(9.0, 4.4) if figure is None else figure
    waveform, spectrum, spectrogram = (figure.add_subplot(2, 2, n) for n in (1, (2, 4), 3))
    draw_waveform(waveform, samples, sample_rate_hz, TOUCH if is_felt else SOUND)
    set_title(waveform, plain(title))
    _draw_spectrogram(spectrogram, samples, sample_rate_hz)
    spectrogram.set_xlim(waveform.get_xlim())
    waveform.tick_params(labelbottom=False)
    waveform.set_xlabel("")
    lines = draw_spectrum(spectrum, samples, sample_rate_hz, TOUCH if is_felt else SOUND)
    labels = ["vibration" if is_felt else "sound", "threshold of touch"]
    add_legend(spectrum, lines, labels, loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, frameon=False)
    return figure


def plot_loop(
    sound: Samples,
    touch: Samples,
    sample_rate_hz: int,
    title: str,
    frequencies_hz: tuple[float, float],
    felt: str | None = None,
    *,
    figure: Figure | SubFigure | None,
) -> Figure | SubFigure:
    """Draw the waveforms of both loops, and their spectra with the threshold of touch. See `HapticLoop.plot`."""
    figure = new_figure(11.0, 4.4) if figure is None else figure
    axes = [figure.add_subplot(2, 2, n) for n in (1, 3, (2, 4))]
    draw_loop(axes[0], axes[1], axes[2], sound, touch, sample_rate_hz, frequencies_hz)
    set_title(axes[0], plain(title))
    if felt is not None:
        set_title(axes[2], felt)
    axes[0].tick_params(labelbottom=False)
    axes[0].set_xlabel("")
    return figure


def draw_loop(
    above: Axes,
    below: Axes,
    spectra: Axes,
    sound: Samples,
    touch: Samples,
    sample_rate_hz: int,
    frequencies_hz: tuple[float, float],
) -> None:
    """Draw the sound into one pair of axes, the vibration into another, and both spectra into the third.

    Parameters: frequencies_hz : the dominant frequency of the sound and of the vibration [Hz], for the legend.
    """
    draw_waveform(above, sound, sample_rate_hz, SOUND)
    draw_waveform(below, touch, sample_rate_hz, TOUCH)
    above.set_ylabel("sound [full scale]")
    below.set_ylabel("vibration [full scale]")
    (heard, _), (felt, threshold) = (
        draw_spectrum(spectra, samples, sample_rate_hz, colour, TACTILE_RANGE_HZ)
        for samples, colour in ((sound, SOUND), (touch, TOUCH))
    )
    raw_hz, felt_hz = frequencies_hz
    labels = [f"sound, peak {raw_hz:.0f} Hz", f"vibration, peak {felt_hz:.0f} Hz", "threshold of touch"]
    add_legend(spectra, [heard, felt, threshold], labels, loc="center left", bbox_to_anchor=(1.01, 0.5))


def draw_waveform(axes: Axes, samples: Samples, sample_rate_hz: int, colour: str) -> None:
    """Draw samples (n_samples,) over time; for a long sound, the lowest and highest sample of each column."""
    x = np.asarray(samples, dtype=np.float64)
    n_columns = min(len(x), _COLUMNS)
    starts = np.linspace(0, len(x), n_columns + 1).astype(np.intp)[:-1]
    time_s = starts / sample_rate_hz
    if n_columns == len(x):
        axes.plot(time_s, x, color=colour, linewidth=0.7, marker="." if len(x) < 3 else "")
    else:
        lowest, highest = np.minimum.reduceat(x, starts), np.maximum.reduceat(x, starts)
        axes.fill_between(time_s, lowest, highest, color=colour, linewidth=0.4)
    most = max(float(np.abs(x).max()), 1e-6)
    axes.set(xlim=(0.0, len(x) / sample_rate_hz), ylim=(-1.08 * most, 1.08 * most))
    axes.set(xlabel="time [s]", ylabel="amplitude [full scale]")


def draw_spectrum(
    axes: Axes, samples: Samples, sample_rate_hz: int, colour: str, range_hz: tuple[float, float] | None = None
) -> tuple[Any, Any]:
    """Draw the amplitudes of `component_levels_db`, and the threshold of touch. Returns both lines."""
    frequency_hz, level_db = component_levels_db(samples, sample_rate_hz)
    low, high = range_hz or (TACTILE_RANGE_HZ[0], max(TACTILE_RANGE_HZ[1], 0.5 * sample_rate_hz))
    (line,) = axes.plot(*_strongest(frequency_hz, level_db, low, high), color=colour, linewidth=0.9, zorder=2)
    felt_hz = np.geomspace(*TACTILE_RANGE_HZ, 200)
    (threshold,) = axes.plot(felt_hz, threshold_db(felt_hz), color=THRESHOLD, linewidth=1.4, linestyle="--", zorder=3)
    axes.set(xscale="log", xlim=(low, high), ylim=(-RANGE_DB, 3.0))
    axes.set(xlabel="frequency [Hz]", ylabel="level [dB re full scale]")
    axes.grid(visible=True, alpha=0.25)
    return line, threshold


def component_levels_db(samples: Samples, sample_rate_hz: int) -> tuple[Floats, Floats]:
    """Return frequencies (n_bins,) [Hz] and the amplitude of a component at each (n_bins,) [dB re full scale].

    No window is applied, since a loop is periodic. Amplitudes are at least -200 dB.
    """
    x = np.asarray(samples, dtype=np.float64)
    amplitude = 2.0 * np.abs(np.fft.rfft(x)) / len(x)
    level_db: Floats = 20.0 * np.log10(np.maximum(amplitude, 1e-10))
    return np.fft.rfftfreq(len(x), 1.0 / sample_rate_hz).astype(np.float64), level_db


def _strongest(frequency_hz: Floats, level_db: Floats, low_hz: float, high_hz: float) -> tuple[Floats, Floats]:
    """Return the strongest component in each of about `_COLUMNS` columns of a logarithmic axis."""
    inside = (frequency_hz >= low_hz) & (frequency_hz <= high_hz)
    f, level = frequency_hz[inside], level_db[inside]
    if len(f) <= _COLUMNS:
        return f, level
    starts = np.unique(np.searchsorted(f, np.geomspace(f[0], f[-1], _COLUMNS)))
    return f[starts], np.maximum.reduceat(level, starts)


def _draw_spectrogram(axes: Axes, samples: Samples, sample_rate_hz: int) -> None:
    x = np.asarray(samples, dtype=np.float64)
    size = min(len(x), max(2, round(_WINDOW_S * sample_rate_hz)))
    starts = np.unique(np.linspace(0, len(x) - size, _FRAMES).astype(np.intp))
    window = hann(size)
    frames = np.lib.stride_tricks.sliding_window_view(x, size)[starts] * window
    amplitude = 2.0 * np.abs(np.fft.rfft(frames, axis=1)) / window.sum()
    top_hz = max(0.5 * sample_rate_hz, 2.0 * TACTILE_RANGE_HZ[0])
    edges_hz = np.geomspace(TACTILE_RANGE_HZ[0], top_hz, _ROWS + 1)
    bin_hz = sample_rate_hz / size
    last = amplitude.shape[1] - 1
    # A row between two bins takes the nearer one.
    first = np.clip(np.rint(edges_hz[:-1] / bin_hz), 0, last).astype(np.intp)
    behind = np.clip(np.rint(edges_hz[1:] / bin_hz), first + 1, last + 1).astype(np.intp)
    rows = np.stack([amplitude[:, a:b].max(axis=1) for a, b in zip(first, behind, strict=True)])
    level_db = 20.0 * np.log10(np.maximum(rows, 1e-10))
    middles_s = (starts + 0.5 * size) / sample_rate_hz
    edges_s = np.concatenate([[0.0], (middles_s[1:] + middles_s[:-1]) / 2, [len(x) / sample_rate_hz]])
    loudest = float(level_db.max())
    image = axes.pcolormesh(
        edges_s, edges_hz, level_db, cmap="cividis", vmin=loudest - RANGE_DB, vmax=loudest, rasterized=True
    )
    axes.set(yscale="log", xlabel="time [s]", ylabel="frequency [Hz]")
    # A colour bar beside the axes would make them narrower than the waveform above.
    axes.figure.colorbar(image, ax=axes, location="bottom", label="level [dB re full scale]", aspect=40, shrink=0.9)
