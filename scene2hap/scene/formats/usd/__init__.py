"""USD scenes (`.usd`, `.usda`, `.usdc`, `.usdz`) as authored trees, through the package usd-core.

The format's only reader is in C++ and crashes on some broken files. So a child process reads the file and returns the
tree. A crash, or a file that fills the memory, then gives one SceneError. See `process`.

Source: OpenUSD 26.11 documentation (Pixar / AOUSD), schemas UsdGeom, UsdShade, UsdPhysics.
"""
