"""Bodies of a scene, each with its receptance: of plates by several models, of rigid bodies, and of parts of them."""
