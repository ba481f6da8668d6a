"""Handlers of the requests, and their answers."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import Any, cast

from scene2hap.bridge import messages
from scene2hap.bridge.client import Client
from scene2hap.bridge.garbage_collection import settle_garbage
from scene2hap.bridge.host import Host
from scene2hap.bridge.hosted_session import HostedSession
from scene2hap.bridge.messages import Document
from scene2hap.bridge.played_session import PlayedSession
from scene2hap.bridge.session_warnings import Tell
from scene2hap.bundle import HapticBundle
from scene2hap.bundle.folder_replacement import require_replaceable
from scene2hap.common import checks
from scene2hap.devices import SINKS
from scene2hap.devices.protocol import ActuatorSink
from scene2hap.errors import BridgeError, BundleIncomplete
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import SceneSnapshot
from scene2hap.session import HapticSession

BAKE_SETTINGS = ("actuator", "enough_candidates", "seed", "spread", "tactile")
"""Bake settings that a client may choose. The server chooses models, keys, prices and folders."""

LONGEST_PREPARATION_S = 60.0
"""Longest time that `play` waits for the propagation model; a client shows its loading screen meanwhile."""


async def answer(request: messages.Request, client: Client, host: Host) -> Document:
    """Run a client's request. Raises: Scene2HapError: it failed; the connection stays open."""
    match request:
        case messages.Hello():
            raise BridgeError("hello was sent already; send it only once, as the first message.")
        case messages.Bake():
            return _bake(request, client, host)
        case messages.Cancel():
            await host.jobs.cancel(request.job)
            return {"type": "cancelled", "job": request.job}
        case messages.Follow():
            return host.jobs.follow(request.job, client.send)
        case messages.Play():
            return await _play(request, client, host)
        case messages.Resume():
            _require_free(client)
            hosted = host.hosted(request.session)
            order = await hosted.resume(client, request.key)
            client.watch(None)
            client.hosted = hosted
            client.repeat(hosted.last_gains)
            return _playing(hosted, order, host)
        case messages.Watch():
            return await _watch(request, client, host)
        case messages.Explain():
            shared = _shared(client)
            explanation = await shared.run(shared.played.session.explain, request.hand)
            return {"type": "explanation", **explanation.to_data()}
        case messages.Stats():
            shared = _shared(client)
            return {"type": "stats", **await shared.run(shared.played.stats)}
        case messages.Leave():
            return await _leave(client)
        case _:
            return await _changed(request, _own(client), host)


async def _changed(request: messages.Request, hosted: HostedSession, host: Host) -> Document:
    """Change the session of a client."""
    played, session = hosted.played, hosted.played.session
    match request:
        case messages.SetSource():
            await hosted.run(
                session.set_source,
                request.source,
                on=request.on,
                state=request.state,
                gain_db=request.gain_db,
                mute=request.mute,
            )
        case messages.SetUser():
            await hosted.run(session.set_user, gain_db=request.gain_db, mute=request.mute, profile=request.profile)
        case messages.StrikeObject():
            await hosted.run(
                session.strike,
                request.object,
                request.point_m,
                speed_m_s=request.speed_m_s,
                impulse_n_s=request.impulse_n_s,
                with_object=request.with_object,
            )
        case messages.Pause():
            await hosted.run(played.pause)
        case messages.Unpause():
            await hosted.run(played.unpause)
        case messages.Moving():
            return await hosted.change_layout(lambda: played.use_layout(request.moving))
        case messages.Remove():
            return await hosted.change_layout(lambda: session.remove(request.object))
        case messages.Add():
            return await hosted.change_layout(lambda: session.add(_one_object(request.object, session)))
        case messages.Spawn():
            folder = _bundle_folder(request.prefab, request.job, "spawn", host)
            pose = Pose(request.position_m, request.rotation_xyzw)
            return await hosted.change_layout(lambda: session.spawn(HapticBundle.load(folder), request.object, pose))
    return {"type": "done"}


def _bake(request: messages.Bake, client: Client, host: Host) -> Document:
    if (request.scene is None) == (request.path is None):
        raise BridgeError("bake needs one of scene and path; give one of them.")
    foreign = [name for name in request.config if name not in BAKE_SETTINGS]
    if foreign:
        raise BridgeError(
            f"{checks.represented(foreign[0])} is no setting of a client's bake; those are {', '.join(BAKE_SETTINGS)}. "
            "The server's settings have the others."
        )
    _require_no_file(request.config)
    target = None if request.save is None else host.below_root(request.save)
    if target is not None:
        require_replaceable(target)  # check before the model costs money
    path = None if request.path is None else host.below_root(request.path)
    host.jobs.require_place()
    # Inputs are taken last: a refused bake leaves no scene file, and the client's pictures for the next one.
    pictures = client.pictures.hand_over() if request.pictures else None
    wanted = {
        "scene": str(path or host.jobs.write(json.dumps(request.scene))),
        "is_sent": path is None,
        "config": {**host.config.bake, **request.config},
        "user_prompt": request.user_prompt,
        "pictures": None if pictures is None else str(pictures),
    }
    return {"type": "baking", "job": host.jobs.start(wanted, target, client.send)}


async def _play(request: messages.Play, client: Client, host: Host) -> Document:
    _require_free(client)
    folder = _bundle_folder(request.bundle, request.job, "play", host)
    _require_no_file(request.session)
    sink = await host.take_sink() if request.use_sink else None
    make = partial(_made, request, folder, host.config.session, sink)
    hosted = HostedSession(make, request.frames, request.keep_s, host.forget)
    try:
        await hosted.open(client)
    except BaseException:
        if sink is not None:
            host.give_sink_back()
        raise
    host.host(hosted, plays_sink=sink is not None)
    client.watch(None)
    client.hosted = hosted
    if host.owns_process:
        await asyncio.to_thread(settle_garbage)
    return _playing(hosted, await hosted.run(hosted.played.order), host)


def _made(
    request: messages.Play,
    folder: Path,
    settings: Mapping[str, Any],
    sink_spec: object,
    tell: Tell,
) -> PlayedSession:
    """Make the session that a client requested. This takes seconds, so it runs on a thread."""
    bundle = HapticBundle.load(folder)
    scene = bundle.snapshot if request.scene is None else SceneSnapshot.from_json(json.dumps(request.scene))
    sink = None if sink_spec is None else cast("ActuatorSink", SINKS.build(sink_spec))
    session = HapticSession(
        scene,
        bundle,
        {"actuator": bundle.actuator or "flat", **settings, **request.session},
        hands=request.hands,
        sink=sink,
        user=request.user,
    )
    # Without this wait, the gains of the first frames would all be 0.
    session.wait_prepared(LONGEST_PREPARATION_S)
    return PlayedSession(session, request.moving, sink, tell)


async def _watch(request: messages.Watch, client: Client, host: Host) -> Document:
    _require_free(client)
    hosted = host.hosted(request.session)
    order = await hosted.run(hosted.played.order)
    client.watch(hosted)
    return {"type": "watching", "session": hosted.id, **order}


async def _leave(client: Client) -> Document:
    client.watch(None)
    hosted, client.hosted = client.hosted, None
    if hosted is not None:
        hosted.player = None
        await hosted.close()
    return {"type": "left"}


def _playing(hosted: HostedSession, order: Document, host: Host) -> Document:
    return {
        "type": "playing",
        "session": hosted.id,
        "key": hosted.key.hex(),
        **order,
        "sink": host.sink_kind if host.plays_sink(hosted) else None,
        "udp_port": host.udp_port,
    }


def _require_free(client: Client) -> None:
    """Raise a BridgeError if a client plays. A session that it watches loses nothing if another takes its place."""
    if client.hosted is not None:
        raise BridgeError("this connection plays a session already; send `leave` first, or open another connection.")


def _own(client: Client) -> HostedSession:
    """Return the session that a client plays. Raises: BridgeError: it plays none."""
    if client.hosted is None:
        whose = "only its player may change a session" if client.watched else "there is no session; send `play` first"
        raise BridgeError(f"{whose}.")
    return client.hosted


def _shared(client: Client) -> HostedSession:
    """Return the session that a client plays or watches. Raises: BridgeError: it has no session."""
    hosted = client.hosted or client.watched
    if hosted is None:
        raise BridgeError("there is no session; send `play` or `watch` first.")
    return hosted


def _bundle_folder(path: str | None, job: int | None, kind: str, host: Host) -> Path:
    if (path is None) == (job is None):
        name = "prefab" if kind == "spawn" else "bundle"
        raise BridgeError(f"{kind} needs one of {name} and job; give one of them.")
    if job is not None:
        return host.jobs.bundle(job)
    folder = host.below_root(path or "")
    if not folder.is_dir():
        if folder.exists():
            raise BundleIncomplete(f"{checks.represented(path)} is a file; a bundle is a folder. Give the folder.")
        near = checks.near_files(folder) or "`bake` with `save` writes one."
        raise BundleIncomplete(f"there is no bundle {checks.represented(path)} below the bridge's root. {near}")
    return folder


def _one_object(row: Document, session: HapticSession) -> SceneObject:
    """Return the object in a row of scene JSON. Raises: SceneError."""
    document = {
        "format": "scene2hap/scene",
        "version": 1,
        "name": "added",
        "up_axis": session.snapshot.up_axis,
        "objects": [row],
    }
    (item,) = SceneSnapshot.from_json(json.dumps(document)).objects
    return item


def _require_no_file(settings: Mapping[str, Any]) -> None:
    """Raise a BridgeError if a setting names a file: clients may read only files below the root, by `path`."""
    actuator = settings.get("actuator")
    if isinstance(actuator, str) and Path(actuator).suffix:
        raise BridgeError(
            f"actuator is {checks.represented(actuator)}, a file; a client gives the name of an actuator, or its "
            "fields. The server's settings may name files."
        )
