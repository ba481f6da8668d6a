"""PortAudio through the package sounddevice: search for devices, and translation of its errors.

PortAudio is ended when the program ends, after the sinks: to end it while a stream plays cuts the sound, and may hang.
sounddevice is imported late and would end it first.

PortAudio lists devices only at its start, so finding a device that was plugged in later needs a restart. A restart ends
every stream, so it is done only while none of ours is open. The lock prevents that two threads call PortAudio at once;
callbacks run without the lock.

Windows lists a device once for each of its interfaces. The others are layers above WASAPI: MME cuts names to 31
characters and adds latency, and PortAudio has it as its default. So WASAPI comes first here.
"""

from __future__ import annotations

import atexit
import ctypes
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Any

import numpy as np

from scene2hap.errors import DeviceError, DeviceNotFound, MissingExtra

WASAPI, MME = "Windows WASAPI", "MME"

_AFTER_WASAPI = {"Windows DirectSound": 1, MME: 2, "Windows WDM-KS": 3}
"""Order of Windows' other interfaces; the last one keeps a device from all other programs."""

_COM_MULTITHREADED = 0

_LOCK = threading.RLock()
_this_thread = threading.local()
_open_streams = 0


@dataclass(frozen=True)
class Card:
    """An output or an input: PortAudio's index, its name and host interface, number of channels and rate."""

    index: int
    name: str
    interface: str
    n_channels: int
    rate_hz: int

    @property
    def may_drop_channels(self) -> bool:
        """True for a sound server behind ALSA: it takes any number of channels, and drops those that its card lacks."""
        return self.interface == "ALSA" and "(hw:" not in self.name

    @property
    def full_name(self) -> str:
        """Name and interface, which together differ from those of all other devices."""
        return f"{self.name}, {self.interface}"

    def __str__(self) -> str:
        return f"{self.index}: {self.name!r} ({self.interface}, {self.n_channels} channels, {self.rate_hz} Hz)"


@atexit.register
def _end() -> None:
    """End PortAudio, unless a driver does not return and a stream is still open."""
    sounddevice = sys.modules.get("sounddevice")
    if sounddevice is not None and _open_streams == 0:
        sounddevice._exit_handler()


def require_sounddevice() -> None:
    """Check that sounddevice is installed. Raises: MissingExtra: it is not."""
    if find_spec("sounddevice") is None:
        raise MissingExtra("the sound card needs sounddevice, which is not installed. "
                           "Run: pip install 'scene2hap[soundcard]'")  # fmt: skip


def cards() -> list[Card]:
    """Return every output device of PortAudio. Raises: DeviceError: there is no PortAudio."""
    return _devices("max_output_channels")


def inputs() -> list[Card]:
    """Return every input of PortAudio, with its channels. Raises: MissingExtra; DeviceError: there is no PortAudio."""
    return _devices("max_input_channels")


def default_input() -> int:
    """Return the index of the system's default input; negative if there is none."""
    return _default("default_input_device")


def find_card(device: str | int | None) -> Card:
    """Return the output with an index, or with a name that is or contains `device`; None for the system's default.

    The name may be followed by a comma and the interface, as in "Headphones, MME". Without it WASAPI comes first.

    Raises: DeviceNotFound; DeviceError: there is no PortAudio.
    """
    with _LOCK:
        found = _match(device)
        if found is None and _open_streams == 0:
            _restart()
            found = _match(device)
        if found is None:
            known = "; ".join(map(str, cards())) or "none"
            wanted = "no default output" if device is None else f"no output {device!r}"
            raise DeviceNotFound(f"{wanted} among the sound cards. Known: {known}.")
        return found


def accepts(card: Card, n_channels: int, rate_hz: int) -> bool:
    """Return True if the device plays this number of channels at this rate; False for a busy or missing device."""
    with _LOCK:
        sd = _sounddevice()
        try:
            sd.check_output_settings(card.index, n_channels, "float32", samplerate=rate_hz)
        except (sd.PortAudioError, ValueError):
            return False
        return True


def open_stream(
    card: Card,
    n_channels: int,
    rate_hz: int,
    latency: float | str,
    block_frames: int,
    play: Callable[..., None],
) -> Any:
    """Return a started `sounddevice.RawOutputStream`. Raises: DeviceError.

    `play` gets an array (n_frames, n_channels) to fill, the number of frames, their time and their status.
    """
    with _LOCK:
        sd = _sounddevice()
        callback = _with_arrays(play, n_channels)
        with _translated(card):
            return _started(
                sd.RawOutputStream(rate_hz, block_frames, card.index, n_channels, "float32", latency, callback=callback)
            )


def open_recording(
    card: Card, n_channels: int, rate_hz: int, block_frames: int, hear: Callable[..., None]
) -> tuple[Any, int]:
    """Return a started `sounddevice.RawInputStream`, and its rate [Hz]: the card's own if the wanted one is not
    possible. `hear` gets the arguments of `open_stream`'s `play`.

    Raises: DeviceError.
    """
    with _LOCK:
        sd = _sounddevice()
        try:
            sd.check_input_settings(card.index, n_channels, "float32", samplerate=rate_hz)
        except (sd.PortAudioError, ValueError):
            rate_hz = card.rate_hz
        with _translated(card):
            callback = _with_arrays(hear, n_channels)
            stream = sd.RawInputStream(
                rate_hz, block_frames, card.index, n_channels, "float32", "low", callback=callback
            )
            return _started(stream), rate_hz


def _with_arrays(callback: Callable[..., None], n_channels: int) -> Callable[..., None]:
    """Return the callback of a raw stream. The arrays of sounddevice's other streams raise a DeprecationWarning in
    every block under NumPy 2.5."""

    def with_buffer(buffer: Any, n_frames: int, when: Any, status: Any) -> None:
        callback(np.frombuffer(buffer, dtype=np.float32).reshape(n_frames, n_channels), n_frames, when, status)

    return with_buffer


def is_active(stream: Any) -> bool:
    """Return True if a stream still requests samples."""
    try:
        return bool(stream.active)
    except _sounddevice().PortAudioError:
        return False


def close_stream(stream: Any) -> None:
    """Close a stream at once."""
    global _open_streams
    with _LOCK:
        try:
            stream.abort(ignore_errors=True)
        finally:
            stream.close(ignore_errors=True)
            _open_streams -= 1


def restart_if_idle() -> None:
    """Search for devices again, unless a stream is open."""
    with _LOCK:
        if _open_streams == 0:
            _restart()


def _restart() -> None:
    sd = _sounddevice()
    sd._terminate()
    sd._initialize()


def named(device: str | int, known: list[Card]) -> Card | None:
    """Return the device with an index, or the first whose name equals `device`, otherwise contains it; with or without
    its interface.
    """
    if isinstance(device, int):
        return next((card for card in known if card.index == device), None)
    wanted = device.casefold()
    exact = [card for card in known if wanted in (card.name.casefold(), card.full_name.casefold())]
    return next(iter(exact or [card for card in known if wanted in card.full_name.casefold()]), None)


def _match(device: str | int | None) -> Card | None:
    return named(_default("default_output_device") if device is None else device, cards())


def _default(which: str) -> int:
    """Return the index of the system's default device, on Windows that of WASAPI; negative if there is none."""
    with _LOCK:
        sd = _sounddevice()
        default = int(sd.default.device[which == "default_output_device"])
        of_interfaces = {str(item["name"]): int(item[which]) for item in sd.query_hostapis()}
        # Another default than MME's was set by the program.
        if default == of_interfaces.get(MME) and of_interfaces.get(WASAPI, -1) >= 0:
            return of_interfaces[WASAPI]
        return default


def _devices(channels: str) -> list[Card]:
    with _LOCK:
        sd = _sounddevice()
        interfaces = [str(item["name"]) for item in sd.query_hostapis()]
        known = [
            Card(i, item["name"], interfaces[item["hostapi"]], item[channels], round(item["default_samplerate"]))
            for i, item in enumerate(sd.query_devices())
            if item[channels] > 0
        ]
        return sorted(known, key=lambda card: _AFTER_WASAPI.get(card.interface, 0))


def _started(stream: Any) -> Any:
    """Start and count a stream, so that a search for devices does not restart PortAudio while it is open."""
    global _open_streams
    try:
        stream.start()
    except _sounddevice().PortAudioError:
        stream.close(ignore_errors=True)
        raise
    _open_streams += 1
    return stream


def _sounddevice() -> Any:
    require_sounddevice()
    try:
        import sounddevice
    except OSError as cause:
        raise DeviceError(
            f"PortAudio cannot be loaded: {cause}. On Debian and Ubuntu: apt-get install libportaudio2; elsewhere "
            "reinstall the package sounddevice, which brings it."
        ) from cause
    atexit.unregister(sounddevice._exit_handler)  # in favour of `_end`
    _initialize_com()
    return sounddevice


def _initialize_com() -> None:
    """Let this thread use WASAPI. PortAudio initializes COM in the thread that starts PortAudio alone, and opening a
    stream in another fails with CO_E_NOTINITIALIZED (PortAudio's issue 250).

    A main thread may belong to a window system, which chooses how COM runs there.
    """
    if sys.platform == "win32" and threading.current_thread() is not threading.main_thread():
        if not hasattr(_this_thread, "has_com"):
            ctypes.windll.ole32.CoInitializeEx(None, _COM_MULTITHREADED)
        _this_thread.has_com = True


@contextmanager
def _translated(card: Card) -> Iterator[None]:
    sd = _sounddevice()
    try:
        yield
    except (sd.PortAudioError, ValueError) as cause:
        raise DeviceError(f"sound card {card.name!r} cannot be opened: {cause}.") from cause
