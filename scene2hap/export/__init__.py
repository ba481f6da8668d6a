"""Exports: a bundle, or the vibration at the hands over time, in the formats of other platforms and programs."""

from scene2hap.export.exporting import export_bundle as export_bundle, export_clip as export_clip
from scene2hap.export.protocol import EXPORTS as EXPORTS, Exported as Exported, Exporter as Exporter
from scene2hap.export.report import ExportReport as ExportReport
from scene2hap.export.track import Channel as Channel, Track as Track
