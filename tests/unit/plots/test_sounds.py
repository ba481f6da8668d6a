"""Figures of sounds and loops: units, the threshold of touch, unusual sounds, hostile titles."""

import io
import sys

import numpy as np
import pytest

from scene2hap import AudioClip, Credit, HapticLoop
from scene2hap.audio.levels import threshold_db
from scene2hap.audio.plots import component_levels_db
from scene2hap.audio.scene_loops import SourceClip, felt_loop, plan_scene
from scene2hap.audio.tactile import CONVERTERS
from scene2hap.cli.tables import place_of
from scene2hap.common.plots import plain, set_title
from scene2hap.errors import MissingExtra
from scene2hap.haptics import ActuatorProfile

figures = pytest.importorskip("matplotlib.figure", reason="needs the extra plots")

RATE = 8000
HOSTILE = ("$\\frac{1}{", "a_b$c$^", "_hidden", "<script>&", "\u202egnp.exe\x1b[2J\n", "電話 ☎", "x" * 500, "")


def tone(hertz: float, seconds: float = 0.5, amplitude: float = 0.25, title: str = "tone") -> AudioClip:
    t = np.arange(round(seconds * RATE)) / RATE
    samples = (amplitude * np.sin(2 * np.pi * hertz * t)).astype(np.float32)
    return AudioClip(samples, RATE, Credit(title, "nobody", "CC0"))


def drawn(figure: object) -> bytes:
    written = io.BytesIO()
    figure.savefig(written, format="png", dpi=40)
    return written.getvalue()


def labels(figure: object) -> list[str]:
    axes = figure.axes
    return [label for one in axes for label in (one.get_xlabel(), one.get_ylabel()) if label]


def test_a_tone_stands_at_its_level_beside_the_threshold_of_touch() -> None:
    clip = tone(250.0)
    figure = clip.plot()
    assert isinstance(figure, figures.Figure)
    assert all("[" in label for label in labels(figure)), labels(figure)
    spectrum = figure.axes[1]
    line, threshold = spectrum.lines
    peak = line.get_ydata().argmax()
    assert line.get_xdata()[peak] == pytest.approx(250.0, abs=1.0)
    assert line.get_ydata()[peak] == pytest.approx(20 * np.log10(0.25), abs=0.01)
    np.testing.assert_allclose(threshold.get_ydata(), threshold_db(threshold.get_xdata()))
    assert drawn(figure).startswith(b"\x89PNG")
    assert figure._repr_png_().startswith(b"\x89PNG")


def test_both_loops_are_drawn_with_their_peaks() -> None:
    figure = HapticLoop(tone(400.0), tone(200.0), 400.0, 200.0).plot(title="phone")
    assert [text.get_text() for text in figure.axes[2].get_legend().get_texts()] == [
        "sound, peak 400 Hz",
        "vibration, peak 200 Hz",
        "threshold of touch",
    ]
    assert figure.axes[0].get_title() == "phone"
    assert all("[" in label for label in labels(figure))


def test_plots_can_be_drawn_into_given_axes() -> None:
    whole = figures.Figure(layout="constrained")
    left, right = whole.subfigures(1, 2)
    assert tone(100.0).plot(figure=left) is left
    assert len(right.axes) == 0
    assert left.axes


@pytest.mark.parametrize(
    "samples", [[0.5], [0.0, 0.0], np.zeros(100), np.ones(3), np.random.default_rng(1).uniform(-1, 1, 400_000)]
)
@pytest.mark.parametrize("rate_hz", [15, 192_000])
def test_odd_sounds_are_drawn(samples: list[float], rate_hz: int) -> None:
    figure = AudioClip(np.asarray(samples, dtype=np.float32), rate_hz).plot()
    assert figure.axes
    if len(samples) == 1 and rate_hz == 15:
        assert drawn(figure)


def test_titles_are_plain_text() -> None:
    figure = figures.Figure()
    for title, axes in zip(HOSTILE, figure.subplots(2, 4).ravel(), strict=True):
        set_title(axes, plain(title))
        shown = axes.get_title()
        assert len(shown) <= 40
        assert not set(shown) & set("\u202e\x1b\n")
        if title.isascii() and title.isprintable() and len(title) <= 40:
            assert shown == title
    drawn(figure)  # formulas would be parsed when drawn
    assert tone(100.0, seconds=0.05, title=HOSTILE[0]).plot().axes[0].get_title() == HOSTILE[0]


def test_no_pyplot_is_loaded() -> None:
    import subprocess

    code = (
        "import sys; from scene2hap import AudioClip; c = AudioClip([0.0, 0.1], 100); "
        "assert 'matplotlib' not in sys.modules; c.plot(); assert 'matplotlib.pyplot' not in sys.modules"
    )
    subprocess.run([sys.executable, "-W", "error", "-c", code], check=True)


def test_a_missing_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with pytest.raises(MissingExtra, match=r"scene2hap\[plots\]"):
        tone(100.0).plot()


def test_components_are_amplitudes() -> None:
    hertz, level_db = component_levels_db(tone(100.0, amplitude=1.0).samples, RATE)
    assert level_db[np.searchsorted(hertz, 100.0)] == pytest.approx(0.0, abs=1e-4)


def test_picture_and_table_state_reached_level_and_original_frequency() -> None:
    t = np.arange(4 * 8000) / 8000
    clip = AudioClip((0.5 * np.sin(2 * np.pi * 49 * t)).astype(np.float32), 8000)
    converter = CONVERTERS.build("auto")
    (plan,) = plan_scene([SourceClip(clip, 0.2, "a")], converter, ActuatorProfile())
    loop = felt_loop(clip, converter, plan)
    titles = [axes.get_title() + axes.get_title(loc="left") for axes in loop.plot().axes]
    assert any(str(loop.felt) in title for title in titles)
    assert place_of(loop) == f"{loop.frequency_tactile_hz:.0f} from 49 rough 49"
