"""glTF and GLB files: container, arrays, compression, skins, instances and materials."""
