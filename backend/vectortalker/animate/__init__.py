"""Turns a project and a track into an animation: animated SVG, web page, video, GIF or PNG frames."""

from vectortalker.animate.run import Options, animate

__all__ = ["Options", "animate"]
