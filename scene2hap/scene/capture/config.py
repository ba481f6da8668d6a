"""Settings of pictures of a scene."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from scene2hap.common.settings import Settings
from scene2hap.scene.images import Shot

_Channel = Annotated[int, Field(ge=0, le=255)]


class CaptureConfig(Settings):
    """Settings of pictures of a scene. All numbers are our choice unless the paper is named.

    size_px : edge of the square pictures.
    azimuths : views around the vertical axis, at equal angles; the paper's four are 90 degrees apart.
    first_azimuth_deg : azimuth of the first view; 0 looks at the side that faces +z (y up) or -y (z up). The default
        shows two sides of a box at different widths.
    elevation_deg : angle above and below the horizontal; 45 in the paper.
    fill : share of the frame that the object's larger extent fills in its isolated images.
    context_factor : context images are this many times wider, from the same eye. Objects that span much of the scene
        are not framed wider than the scene.
    outline_share, outline_rgb : width of the outline as a share of `size_px`, and its colour.
    near_share : an object is part of the target's surroundings if the gap of their boxes is less than this share of the
        target's diagonal.
    hidden_share : share of the target's silhouette that its surroundings may hide together; see `culling`.
    antialias : smooth edges by two more rays where neighbouring pixels differ; costs a seventh more time.
    share_copies : objects of one `instance_key` share isolated images. They also share context images if they are
        copies (equal names and sizes, `scene.copies`) that stand or hang on objects of the same kind. False renders
        every object.
    workers : processes of `render_all`, this one included; 0 and 1 render only in this process.
    cache_dir : a folder that keeps pictures between runs; None keeps them only in memory.
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
    outline_rgb: tuple[_Channel, _Channel, _Channel] = (255, 0, 190)
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
        """All settings that affect a pixel, as text; equal settings give equal pictures."""
        return self.model_dump_json(exclude={"workers", "cache_dir", "share_copies"})

    def scene_shots(self) -> tuple[Shot, ...]:
        """Return the pictures of the whole scene, all from above."""
        return tuple(Shot("scene", None, azimuth, self.elevation_deg) for azimuth in self._azimuths_deg)

    def object_shots(self, kind: Literal["isolated", "context"], subject: str) -> tuple[Shot, ...]:
        """Return the pictures of an object, first from above, then from below."""
        elevations = (self.elevation_deg, -self.elevation_deg)
        return tuple(Shot(kind, subject, azimuth, tilt) for tilt in elevations for azimuth in self._azimuths_deg)

    @property
    def _azimuths_deg(self) -> tuple[float, ...]:
        return tuple(self.first_azimuth_deg + 360.0 * turn / self.azimuths for turn in range(self.azimuths))
