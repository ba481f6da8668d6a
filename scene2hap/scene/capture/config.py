"""Settings of pictures of a scene."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from pydantic import Field

from scene2hap.scene.images import Shot
from scene2hap.settings import Settings


class CaptureConfig(Settings):
    """Settings of pictures of a scene. Every number here is a choice of ours where the paper names none.

    size_px : edge of the square pictures.
    azimuths : views around the vertical axis, evenly spread; the paper's four are 90 degrees apart.
    first_azimuth_deg : where they start; 0 looks at what faces +z (y up) or -y (z up). The default shows a box on two
        sides of different width.
    elevation_deg : angle above and below the horizontal; 45 in the paper.
    fill : part of the frame that the object's larger extent takes in its isolated images.
    context_factor : how many times wider context images look, from the same eye. Objects that span much of the scene
        are not framed wider than the scene is.
    outline_share, outline_rgb : width of the outline as a part of `size_px`, and its colour.
    near_share : things whose box is nearer to the target's than this part of its diagonal are its surroundings.
    hidden_share : part of the target's silhouette that its surroundings may hide together; see `culling`.
    antialias : smooth edges by two more rays where neighbouring pixels differ; costs a seventh more time.
    share_copies : objects of one `instance_key` share isolated images, and context images too if they are copies
        (names and size as well, `scene.likeness`) that stand on the same kind of thing; False takes every object's own.
    workers : processes of `render_all`, this one among them; 0 and 1 render here alone.
    cache_dir : a folder that keeps pictures between runs, None for memory alone.
    """

    of_what = "capture"

    size_px: int = Field(default=512, ge=16, le=4096)
    renderer: str = "embree"
    azimuths: int = Field(default=4, ge=1, le=36)
    first_azimuth_deg: float = Field(default=30.0, ge=-360.0, le=360.0)
    elevation_deg: float = Field(default=45.0, gt=0.0, lt=90.0)
    fill: float = Field(default=0.75, ge=0.1, le=1.0)
    context_factor: float = Field(default=2.5, ge=1.0, le=20.0)
    outline_share: float = Field(default=1 / 128, gt=0.0, le=0.1)
    outline_rgb: tuple[int, int, int] = (255, 0, 190)
    near_share: float = Field(default=0.1, ge=0.0, le=1.0)
    hidden_share: float = Field(default=0.35, ge=0.0, le=1.0)
    antialias: bool = False
    share_copies: bool = True
    workers: int = Field(default=0, ge=0, le=64)
    cache_dir: Path | None = None

    @property
    def outline_px(self) -> int:
        """Width of the outline, at least one pixel."""
        return max(1, round(self.outline_share * self.size_px))

    @property
    def look(self) -> str:
        """All settings that a pixel can depend on, as text; equal settings give equal pictures."""
        return self.model_dump_json(exclude={"workers", "cache_dir", "share_copies"})

    def scene_shots(self) -> tuple[Shot, ...]:
        """The pictures of the whole scene, all from above."""
        return tuple(Shot("scene", None, azimuth, self.elevation_deg) for azimuth in self._azimuths_deg)

    def object_shots(self, kind: Literal["isolated", "context"], subject: str) -> tuple[Shot, ...]:
        """The pictures of an object: those from above, then those from below."""
        elevations = (self.elevation_deg, -self.elevation_deg)
        return tuple(Shot(kind, subject, azimuth, tilt) for tilt in elevations for azimuth in self._azimuths_deg)

    @property
    def _azimuths_deg(self) -> tuple[float, ...]:
        return tuple(self.first_azimuth_deg + 360.0 * turn / self.azimuths for turn in range(self.azimuths))
