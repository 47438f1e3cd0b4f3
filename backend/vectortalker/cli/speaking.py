"""What `speech` and `talk` share: options of speech, and the track of a recording with a progress bar."""

from __future__ import annotations

import argparse
import math
import os
from pathlib import Path
from typing import TYPE_CHECKING

from vectortalker.cli.inputs import read_file
from vectortalker.errors import VectorTalkerError

if TYPE_CHECKING:
    from vectortalker.cli.progress import Bar
    from vectortalker.schema import Track
    from vectortalker.speech import Options

STYLES = ("subtle", "normal", "cartoon")
MAX_TRANSCRIPT_BYTES = 1_000_000
FACTOR_LIMIT = 4.0


def add_speech_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--transcript", metavar="TEXT_OR_FILE", help="what is said: better than hearing alone")
    parser.add_argument(
        "--language", default="en", help="of the transcript, as espeak-ng names it (default: %(default)s)"
    )
    parser.add_argument("--style", choices=STYLES, default="normal", help="default: %(default)s")
    parser.add_argument("--amplitude", type=float, default=1, metavar="FACTOR", help="of the mouth's motion")
    parser.add_argument("--smoothing", type=float, default=1, metavar="FACTOR", help="of the mouth's motion")
    parser.add_argument(
        "--gain", action="append", default=[], metavar="CHANNEL=FACTOR", help="of mouth, blink, head, brows; 0 mutes"
    )
    parser.add_argument(
        "--model",
        type=Path,
        metavar="FILE.onnx",
        help="a net of your own, from sound of 16 kHz [1, n] to 68 landmarks a frame [1, frames, 136]",
    )


def spoken_track(options: argparse.Namespace, bar: Bar) -> Track:
    """The track of the recording: by the package's network, or by a model of the user's own.

    Raises `bad_audio`, and `bad_option` as `speech_options` does and for options that only the network has.
    """
    from vectortalker.speech import track_by_model, track_from_audio

    if options.model is None:
        return track_from_audio(options.audio, speech_options(options), bar.show)
    if options.transcript is not None:
        raise VectorTalkerError("bad_option", "--transcript goes with the network of the package: leave --model out.")
    return track_by_model(options.audio, options.model, bar.show)


def speech_options(options: argparse.Namespace) -> Options:
    """Raises `bad_option` for factors that are none, and for a transcript file that cannot be read."""
    from vectortalker.speech import Options

    return Options(
        style=options.style,
        transcript=None if options.transcript is None else _text(options.transcript),
        language=options.language,
        amplitude=_factor("--amplitude", str(options.amplitude)),
        smoothing=_factor("--smoothing", str(options.smoothing)),
        seed=options.seed or 0,
        gains=dict(_gain(given) for given in options.gain),
    )


def _text(given: str) -> str:
    """The text of the file of that name, or the words themselves."""
    if not os.path.isfile(given):  # unlike Path.is_file, false for text too long to be a name
        return given
    try:
        return read_file(Path(given), "bad_option", MAX_TRANSCRIPT_BYTES).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise VectorTalkerError("bad_option", f"{given} is not UTF-8 text: save the transcript as such.") from error


def _gain(given: str) -> tuple[str, float]:
    name, _, factor = given.partition("=")
    return name, _factor(f"--gain {name}", factor)


def _factor(flag: str, given: str) -> float:
    try:
        factor = float(given)
    except ValueError:
        factor = math.nan
    if not 0 <= factor <= FACTOR_LIMIT:
        raise VectorTalkerError("bad_option", f"{flag} {given}: a factor within 0 and {FACTOR_LIMIT:g} is needed.")
    return factor
