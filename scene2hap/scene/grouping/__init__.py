"""From the nodes of a file or an engine to objects that a user would point at, as rigidly posed meshes."""
