"""Turns an animated SVG, and sound if there is any, into one web page that needs no other file."""

from __future__ import annotations

import base64
from string import Template
from xml.sax.saxutils import escape

# The sound is the master clock: SMIL time is set from it before every paint, so that lips never run away from the
# voice, whatever the machine skips. Without sound the animation runs by itself and a click or the space bar pauses it.
_PAGE = Template("""<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>$title</title>
<style>
  body { margin: 0; min-height: 100vh; display: grid; place-content: center; gap: 1rem; background: Canvas }
  svg { display: block; width: auto; height: auto; max-width: 100vw; max-height: calc(100vh - 5rem) }
  audio { width: 100% }
</style>
<main>
$svg
$player
</main>
</html>
""")

_SOUND = Template("""<audio controls src="data:audio/mp4;base64,$audio"></audio>
<script>
  const svg = document.querySelector('svg')
  const audio = document.querySelector('audio')
  const follow = () => {
    svg.setCurrentTime(audio.currentTime)
    if (!audio.paused) requestAnimationFrame(follow)
  }
  svg.pauseAnimations()
  audio.addEventListener('play', follow)
  audio.addEventListener('seeked', follow)
</script>""")

_SILENCE = """<script>
  const svg = document.querySelector('svg')
  const toggle = () => (svg.animationsPaused() ? svg.unpauseAnimations() : svg.pauseAnimations())
  if (matchMedia('(prefers-reduced-motion: reduce)').matches) svg.pauseAnimations()
  svg.addEventListener('click', toggle)
  document.addEventListener('keydown', (event) => event.key === ' ' && toggle())
</script>"""


def page(svg: str, title: str, audio: bytes | None) -> str:
    """HTML text around the text of an animated `svg`; `audio` is an MP4 sound file."""
    player = _SILENCE if audio is None else _SOUND.substitute(audio=base64.b64encode(audio).decode())
    return _PAGE.substitute(title=escape(title), svg=svg, player=player)
