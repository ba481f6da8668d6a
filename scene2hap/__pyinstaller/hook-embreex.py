"""List the modules of embreex, which its compiled code imports where PyInstaller cannot see it."""

from PyInstaller.utils.hooks import collect_submodules

hiddenimports = collect_submodules("embreex")
