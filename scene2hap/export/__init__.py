"""Exports: a bundle, or the vibration at the hands over time, in the formats of other platforms and programs."""

from scene2hap.export.exporting import export_bundle as export_bundle
from scene2hap.export.exporting import export_clip as export_clip
from scene2hap.export.protocol import EXPORTS as EXPORTS
from scene2hap.export.protocol import Exported as Exported
from scene2hap.export.protocol import Exporter as Exporter
from scene2hap.export.report import ExportReport as ExportReport
from scene2hap.export.track import Channel as Channel
from scene2hap.export.track import Track as Track
