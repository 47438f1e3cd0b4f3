"""VectorTalker: layered SVG portraits that talk."""
