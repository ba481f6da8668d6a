"""Contract tests detect each broken rule of a plugin, with a message that names the plugin."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from scene2hap import ExponentialPlate, MemorySink
from scene2hap.audio.clip import AudioClip, Credit
from scene2hap.audio.sources.synth import Synthesizer
from scene2hap.audio.tactile import CONVERTERS
from scene2hap.devices.protocol import SinkFormat, SinkStats
from scene2hap.errors import Scene2HapError
from scene2hap.llm.lexicon import LexiconBackend
from scene2hap.llm.protocol import LLMReply, LLMRequest
from scene2hap.propagation.controls import FullPropagation
from scene2hap.testing import (
    check_actuator_sink,
    check_audio_source,
    check_llm_backend,
    check_propagation_model,
    check_renderer,
    check_tactile_converter,
)

Change = Callable[..., Any]


class Field:
    """A field of `FullPropagation` whose gains a test changes."""

    def __init__(self, whole: Any, change: Change) -> None:
        self.source_ids, self._whole, self._change = whole.source_ids, whole, change

    def attenuation(self, object_id: str, points_m: NDArray[np.float64]) -> Any:
        return self._change(self._whole.attenuation(object_id, points_m), object_id, points_m)


class Model:
    def __init__(self, change: Change) -> None:
        self._change = change

    def prepare(self, network: Any, excitations: Any, bands: Any) -> Any:
        return Field(FullPropagation().prepare(network, excitations, bands), self._change)


class NoSources:
    def prepare(self, network: Any, excitations: Any, bands: Any) -> Any:
        return object()


class OtherSources(Model):
    def prepare(self, network: Any, excitations: Any, bands: Any) -> Any:
        field = super().prepare(network, excitations, bands)
        field.source_ids = ("cup",)
        return field


class Reused(Model):
    """Its fields answer in one array for each shape."""

    def __init__(self) -> None:
        arrays: dict[Any, NDArray[np.float64]] = {}

        def reused(found: NDArray[np.float64], *_: Any) -> NDArray[np.float64]:
            array = arrays.setdefault(found.shape, np.zeros_like(found))
            array[:] = found
            return array

        super().__init__(reused)


class Forgetful(Model):
    """All its fields answer for the scene that was prepared last."""

    def __init__(self) -> None:
        super().__init__(lambda _, object_id, points: self._last.attenuation(object_id, points))

    def prepare(self, network: Any, excitations: Any, bands: Any) -> Any:
        self._last = FullPropagation().prepare(network, excitations, bands)
        return super().prepare(network, excitations, bands)


class FromAToB(Model):
    """Contacts conduct from a to b only."""

    def prepare(self, network: Any, excitations: Any, bands: Any) -> Any:
        touched = {contact.b for contact in network.contacts}
        self._change = lambda found, object_id, _: found * (object_id in touched or object_id == "phone")
        return super().prepare(network, excitations, bands)


def moved_points(found: Any, _: str, points: NDArray[np.float64]) -> Any:
    points += 1.0
    return found


class Bodies(FullPropagation):
    """Reads the body of every source."""

    def prepare(self, network: Any, excitations: Any, bands: Any) -> Any:
        _ = [network.bodies[one.source_id] for one in excitations]
        return super().prepare(network, excitations, bands)


class Corners(FullPropagation):
    """Takes the corner of a plate for the place of an object."""

    def prepare(self, network: Any, excitations: Any, bands: Any) -> Any:
        _ = [network.poses[one.source_id] for one in excitations if one.source_id != "fan"]
        return super().prepare(network, excitations, bands)


def known_alone(found: Any, key: str, _: Any) -> Any:
    return found * {"table": 1.0, "phone": 1.0, "shelf": 1.0}[key]


MODELS: list[tuple[Any, str]] = [
    (object(), "object has no 'prepare'"),
    (NoSources(), "NoSources.prepare gave no PropagationField: object has no 'source_ids'"),
    (OtherSources(lambda found, *_: found), r"of the sources ['cup']"),
    (Model(lambda found, *_: found[0]), "Model's field has shape"),
    (Model(lambda found, *_: found.astype(np.float32)), "is float32; it must be float64"),
    (Model(lambda found, *_: found * np.nan), "not finite"),
    (Model(lambda found, *_: found - 1), "it must be at least 0"),
    (Model(lambda found, *_: found / 2), "a source is felt on itself by 0.5; it must be 1"),
    (Model(lambda found, *_: np.maximum(found, 0.1)), "it must be"),
    (Model(lambda found, key, _: found + 0.2 * (key == "shelf")), "arrives on 'shelf', which nothing reaches"),
    (Model(lambda found, key, points: found * (len(points) if key == "table" else 1)), "depends on the others"),
    (Model(moved_points), "changed the points that it was given"),
    (Model(lambda found, *_: found + 1e-6), "a source is felt on itself by 1.000001; it must be 1"),
    (Reused(), "Reused: a query changes the array of the one before"),
    (Forgetful(), "Forgetful: preparing another scene changes a field"),
    (Model(lambda found, key, _: found + 0.2 * (key == "shelf")), "it must be 0, or the class declare follows_poses"),
    (Bodies(), "Bodies.prepare raised KeyError('fan') at " + __file__),
    (Bodies(), "; source 'fan' has no body; a source may have none and touch nothing"),
    (Corners(), "; source 'phone' may have no pose"),
    (Model(known_alone), "; object 'cup' is in no network; a field must answer there too"),
    (Model(lambda *_: 1 / 0), "at 'table' raised ZeroDivisionError("),
    (FromAToB(lambda found, *_: found), "with a and b of each contact swapped"),
]


class Live(ExponentialPlate):
    """Its live field is that of the law, of which a test changes one method."""

    def __init__(self, method: str, change: Change) -> None:
        super().__init__()
        self._method, self._change = method, change

    def live(self, *given: Any) -> Any:
        field: Any = super().live(*given)
        whole = getattr(field, self._method)
        changed = partial(self._change, whole) if callable(whole) else self._change(whole)
        object.__setattr__(field, self._method, changed)
        return field


class Stale(Live):
    def __init__(self) -> None:
        super().__init__("strongest", lambda whole, hands: whole(hands))
        self._change = lambda whole, hands: self._known.setdefault(repr(hands), whole(hands))
        self._known: dict[str, Any] = {}

    def live(self, *given: Any) -> Any:
        self._known = {}
        return super().live(*given)


MODELS += [
    (Live("source_ids", lambda ids: ids[:1]), "the live field of Live has the sources"),
    (Live("strongest", lambda whole, hands: whole(hands)[0]), "the live field of Live has shape"),
    (Live("strongest", lambda whole, hands: whole(hands).astype(np.float32)), "is float32; it must be float64"),
    (Live("strongest", lambda whole, hands: whole(hands) * np.nan), "the live field of Live holds a value that is not"),
    (Live("most", lambda most: 0.5 * most), "more than its `most`, 0.5"),
    (Live("strongest", lambda whole, hands: 0.5 * whole(hands)), "a source is felt on itself by 0.5; it must be 1"),
    (Live("strongest", lambda whole, hands: np.maximum(whole(hands), 1e-9)), "a hand that touches nothing feels 1e-09"),
    (Live("strongest", lambda whole, hands: whole(hands) ** 1.1), "differs from the prepared field, by up to"),
    (Live("strongest", lambda whole, hands: whole([hands[0] for _ in hands])), "a hand that touches nothing feels"),
    (Stale(), "the live field of Stale does not follow contacts that end"),
    (Live("at", lambda whole, costs, columns=None: whole(costs)), "at(costs, columns) differs from at(costs)"),
    (
        Live("path_costs", lambda whole, hands, limits=None, *_: whole(hands, limits and [0.0] * 2)),
        "up to a limit differ",
    ),
    (Live("from_point", lambda whole, *given: 0.9 * whole(*given)), "from_point of the live field of Live has 0.9"),
]


@pytest.mark.parametrize(("model", "words"), MODELS)
def test_broken_propagation_models_fail_the_contract(model: Any, words: str) -> None:
    with pytest.raises((AssertionError, Scene2HapError), match=re.escape(words)):
        check_propagation_model(model)


class Idle(MemorySink):
    def pull(self, n_frames: int) -> Any:
        return np.zeros((n_frames, 2), np.float32)


class Uncounted(MemorySink):
    stats = SinkStats()


class Wordless(MemorySink):
    stats = None


class OpensAlone(MemorySink):
    def open(self) -> None:
        pass


class Once(MemorySink):
    def open(self, format: SinkFormat) -> None:
        super().open(format)
        self.n_stops = 0

    def stop(self) -> None:
        super().stop()
        self.n_stops = getattr(self, "n_stops", 0) + 1
        assert self.n_stops < 2, "Once was stopped twice"


def requesting(n_frames: float) -> type[MemorySink]:
    """A sink that requests this many frames."""

    class Requesting(MemorySink):
        def start(self, fill: Any) -> None:
            self.n_requested, self._ask = 0, fill

        def pull(self, _: int) -> Any:
            self._ask(n_frames)
            self.n_requested += 1

        @property
        def stats(self) -> SinkStats:
            return SinkStats(frames=getattr(self, "n_requested", 0))

    return Requesting


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (object, "object has no 'open'"),
        (OpensAlone, r"OpensAlone.open\(\) must take \(format\)"),
        (Idle, "Idle has requested no frames"),
        (Uncounted, "Uncounted.stats has 0 frames after"),
        (Wordless, "Wordless.stats is a NoneType"),
        (Once, "Once was stopped twice"),
        (requesting(-1), "Requesting requested -1 frames"),
        (requesting(240.5), "Requesting requested 240.5 frames"),
    ],
)
def test_broken_sinks_fail_the_contract(make: Any, words: str) -> None:
    with pytest.raises(AssertionError, match=words):
        check_actuator_sink(make, within_s=0.2)


class Converter:
    """The low-pass, with changed blocks and a changed end."""

    def __init__(self, change: Change, end: Change = lambda rest: rest) -> None:
        self._change, self._end, self._whole = change, end, CONVERTERS.build("lowpass")

    def stream(self, sample_rate_hz: int, context: Any) -> Any:
        plugin, stream = self, self._whole.stream(sample_rate_hz, context)

        class Stream:
            def process(self, block: Any) -> Any:
                return plugin._change(stream.process(block))

            def finish(self) -> Any:
                return plugin._end(stream.finish())

        return Stream()


class Deaf(Converter):
    def stream(self, sample_rate_hz: int, context: Any) -> Any:
        stream = super().stream(sample_rate_hz, context)
        process = stream.process
        stream.process = lambda block: process(np.nan_to_num(block, posinf=0, neginf=0))
        return stream


class InPlace(Converter):
    """It halves its input in the caller's array."""

    def stream(self, sample_rate_hz: int, context: Any) -> Any:
        stream = super().stream(sample_rate_hz, context)
        process = stream.process

        def halving(block: Any) -> Any:
            found = process(block)
            block *= 0.5
            return found

        stream.process = halving
        return stream


class OneStream(Converter):
    """All its streams share one state, which is reset when a stream is opened."""

    def stream(self, sample_rate_hz: int, context: Any) -> Any:
        self._stream = super().stream(sample_rate_hz, context)
        return self

    def process(self, block: Any) -> Any:
        return self._stream.process(block)

    def finish(self) -> Any:
        return self._stream.finish()


@pytest.mark.parametrize(
    ("converter", "words"),
    [
        (object(), "object has no 'stream'"),
        (Converter(lambda block: None), "the stream of Converter gave None"),
        (Converter(lambda block: np.stack([block, block])), "it must give samples"),
        (Converter(lambda block: block[1:]), "Converter makes .* samples of"),
        (Converter(lambda block: block * np.nan), "not finite"),
        (Converter(lambda block: 30 * block), "full scale is 1"),
        (Converter(lambda block: 0 * block), "makes a hum silent"),
        (Converter(lambda block: block + 0.01 * (1 - abs(block))), "of silence"),
        (Converter(lambda block: block * (1 - 0.1 * (len(block) < 100))), "blocks of other sizes give other samples"),
        (Deaf(lambda block: block), "takes a sample that is nan"),
        (InPlace(lambda block: block), "InPlace changes the block that it is given"),
        (OneStream(lambda block: block), "OneStream: two streams at once change each other"),
    ],
)
def test_broken_converters_fail_the_contract(converter: Any, words: str) -> None:
    with pytest.raises((AssertionError, Scene2HapError), match=words):
        check_tactile_converter(converter)


class Source:
    def __init__(self, found: Callable[[], Any]) -> None:
        self._found = found

    def find(self, description: Any) -> Any:
        return self._found()


def clip(samples: Any, title: str = "a sound") -> AudioClip:
    return AudioClip(np.asarray(samples, np.float32), 48_000, Credit(title, "me", "CC0-1.0"))


class Restless(Synthesizer):
    def find(self, description: Any) -> Any:
        return [clip(np.random.default_rng().uniform(-1, 1, 4800))]


@pytest.mark.parametrize(
    ("source", "words"),
    [
        (object(), "object has no 'find'"),
        (Source(lambda: None), "Source.find gives a NoneType"),
        (Source(lambda: (clip([1.0]),)), "Source.find gives a tuple"),
        (Source(lambda: [np.zeros(9)]), "Source.find gives a ndarray"),
        (Source(list), "Source finds nothing for 'smartphone buzzing'"),
        (Source(lambda: [clip(np.zeros(4800))]), "a clip that is silent"),
        (Restless(), "Restless finds something else"),
    ],
)
def test_broken_sources_fail_the_contract(source: Any, words: str) -> None:
    with pytest.raises(AssertionError, match=words):
        check_audio_source(source)


class Backend:
    def __init__(self, change: Callable[[LLMReply, LLMRequest], Any]) -> None:
        self._change = change

    async def complete(self, request: LLMRequest) -> Any:
        return self._change(await LexiconBackend().complete(request), request)


class Hasty:
    def complete(self, request: LLMRequest) -> LLMReply:
        return LLMReply("{}", "hasty")


def only(component: str, text: str) -> Callable[[LLMReply, LLMRequest], LLMReply]:
    return lambda reply, request: LLMReply(text, "m") if request.component == component else reply


def spoiled(reply: LLMReply, request: LLMRequest) -> LLMReply:
    request.facts["object_name"] = "spoon"
    return reply


@pytest.mark.parametrize(
    ("backend", "words"),
    [
        (object(), "object has no 'complete'"),
        (Hasty(), "write it as 'async def complete'"),
        (Backend(lambda reply, _: reply.text), "Backend.complete gives a str"),
        (Backend(lambda reply, _: LLMReply(reply.text, "")), "does not say which model answered"),
        (Backend(lambda reply, _: LLMReply("", "m")), "answered without content"),
        (Backend(lambda reply, _: LLMReply('{"wrong": 1}', "m")), "object_category: it is missing"),
        (Backend(spoiled), "changed the facts"),
        (Backend(only("scene_analyzer", "[]")), "invalid answers: scene_analyzer"),
        (Backend(only("material_estimator", '{"density_kg_m3": "heavy"}')), "invalid answers: material_estimator"),
        (Backend(only("vibration_describer", "It hums.")), "invalid answers: vibration_describer"),
    ],
)
def test_broken_backends_fail_the_contract(backend: Any, words: str) -> None:
    with pytest.raises((AssertionError, Scene2HapError), match=words):
        check_llm_backend(backend)


class Renderer:
    """A renderer that draws a row for each shown item, and then changes the result."""

    def __init__(self, render_scene: Any, smooth: bool) -> None:
        pass

    def identify(self, camera: Any, selection: Any) -> Any:
        ids = np.full((camera.size_px,) * 2, -1, np.int32)
        for row, number in enumerate(sorted(selection.shown)):
            ids[3 + row] = number
        return ids

    def draw(self, camera: Any, selection: Any) -> Any:
        ids = self.identify(camera, selection)
        return np.repeat(np.where(ids < 0, 255, 0)[..., None], 3, axis=2).astype(np.uint8), ids


def changed(change: Callable[[Any, Any], Any]) -> type[Renderer]:
    class Changed(Renderer):
        def draw(self, camera: Any, selection: Any) -> Any:
            return change(*super().draw(camera, selection))

    return Changed


def restless(pixels: Any, ids: Any) -> Sequence[Any]:
    pixels[0, 0] = np.random.default_rng().integers(0, 200, 3)
    return pixels, ids


def test_a_plain_renderer_passes() -> None:
    check_renderer(Renderer)


@pytest.mark.parametrize(
    ("factory", "words"),
    [
        (lambda render_scene: None, "must take"),
        (lambda render_scene, smooth: None, "None has no 'identify'"),
        (changed(lambda pixels, ids: pixels), "gave a ndarray; it must give pixels and ids"),
        (changed(lambda pixels, ids: (pixels[:9], ids)), "gave pixels of shape"),
        (changed(lambda pixels, ids: (pixels / 255, ids)), "float64"),
        (changed(lambda pixels, ids: (pixels.astype(int), ids)), "it must be uint8"),
        (changed(lambda pixels, ids: (pixels, ids + 1)), "shows the objects"),
        (changed(lambda pixels, ids: (pixels, np.roll(ids, 1, axis=0))), "identify and draw tell other ids"),
        (changed(lambda pixels, ids: (np.full_like(pixels, 255), ids)), "in the colour of the background"),
        (changed(restless), "when it draws again"),
    ],
)
def test_broken_renderers_fail_the_contract(factory: Any, words: str) -> None:
    with pytest.raises((AssertionError, Scene2HapError), match=words):
        check_renderer(factory)


@pytest.mark.parametrize(
    ("check", "given", "words"),
    [
        (check_propagation_model, FullPropagation, r"is a class; make one of it, FullPropagation\(...\)"),
        (check_llm_backend, LexiconBackend, r"is a class; make one of it, LexiconBackend\(...\)"),
        (check_actuator_sink, MemorySink(), "make is a MemorySink; it must be the class"),
        (check_renderer, None, "factory is None; it must be the class"),
    ],
)
def test_a_class_in_place_of_an_instance_is_named_and_the_other_way_round(
    check: Callable[[Any], None], given: Any, words: str
) -> None:
    with pytest.raises(AssertionError, match=words):
        check(given)
