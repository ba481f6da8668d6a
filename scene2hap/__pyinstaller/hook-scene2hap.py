"""List what PyInstaller cannot see in the source of scene2hap.

Kinds, compiled kernels and public names are imported by names that are made at run time. Tables, prompts and the demo
are data files. Plug-ins of other packages are found by their entry points.
"""

from importlib.metadata import entry_points

from PyInstaller.utils.hooks import collect_data_files, collect_entry_point, collect_submodules

# Packages of extras that are not installed do not import, and stay out.
hiddenimports = collect_submodules(
    "scene2hap", filter=lambda name: not name.startswith("scene2hap.__pyinstaller"), on_error="ignore"
)
datas = collect_data_files("scene2hap", excludes=["**/*.pyx", "**/*.pxd"])
# Scripts for the Python of a text-to-audio model, which runs them from their files.
datas += collect_data_files("scene2hap", subdir="audio/sources/runners", include_py_files=True)
for group in sorted(name for name in entry_points().groups if name.startswith("scene2hap.")):
    metadata, modules = collect_entry_point(group)
    datas += metadata
    hiddenimports += modules
