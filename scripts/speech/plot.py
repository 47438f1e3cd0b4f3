"""Draws spectrogram, waveform, lip opening and visemes of recordings over one another, and tells how they go together.

    python scripts/speech/plot.py OUT_FOLDER AUDIO… [--transcript TEXT --language en]

Needs matplotlib.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import matplotlib as mpl
import numpy as np

mpl.use("Agg")
from evaluate import lip_gap
from matplotlib import pyplot as plt
from vectortalker.schema import Track
from vectortalker.speech import Options, as_landmarks, track_from_audio
from vectortalker.speech.audio import RATE, mono_chunks
from vectortalker.speech.features import levels, log_mels
from vectortalker.speech.visemes import VISEMES

SECONDS_A_ROW = 3.0


def draw(path: Path, track: Track, out: Path) -> None:
    samples = np.concatenate(list(mono_chunks(path)))
    gap = lip_gap(as_landmarks(track).landmarks)
    n_rows = int(np.ceil(track.duration / SECONDS_A_ROW))
    figure, axes = plt.subplots(2 * n_rows, 1, figsize=(18, 5 * n_rows), squeeze=False)
    for row in range(n_rows):
        start = row * SECONDS_A_ROW
        spectrum, curves = axes[2 * row, 0], axes[2 * row + 1, 0]
        piece = samples[round(start * RATE) : round((start + SECONDS_A_ROW) * RATE)]
        spectrum.specgram(piece + 1e-6, NFFT=256, noverlap=192, Fs=RATE, xextent=(start, start + len(piece) / RATE))
        curves.plot(np.arange(len(piece)) / RATE + start, 0.3 * piece / max(1e-3, np.abs(samples).max()), lw=0.3)
        curves.plot(np.arange(len(gap)) / track.fps, gap, "r")
        for block in (track.model_extra or {})["visemes"]:
            middle = block["t"] + block["d"] / 2
            if block["viseme"] != "sil" and start <= middle < start + SECONDS_A_ROW:
                colour = "red" if block["viseme"] in ("PP", "FF") else f"C{VISEMES.index(block['viseme']) % 10}"
                curves.axvspan(block["t"], block["t"] + block["d"], color=colour, alpha=0.15)
                curves.text(middle, 0.5, block["viseme"], ha="center")
        for axis in (spectrum, curves):
            axis.set_xlim(start, start + SECONDS_A_ROW)
        curves.set_ylim(-0.35, 0.6)
    figure.tight_layout()
    figure.savefig(out, dpi=50)
    plt.close(figure)


def loudness_correlation(path: Path, track: Track) -> float:
    """Of the lip opening with the loudness, frame by frame: lips that follow nothing but loudness have 1, still 0."""
    loudness = levels(log_mels(mono_chunks(path)))[::2]
    gap = lip_gap(as_landmarks(track).landmarks)
    n_frames = min(len(gap), len(loudness))
    if np.ptp(gap) == 0 or np.ptp(loudness) == 0:
        return 0.0
    return float(np.corrcoef(gap[:n_frames], loudness[:n_frames])[0, 1])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out", type=Path)
    parser.add_argument("audio", type=Path, nargs="+")
    parser.add_argument("--transcript")
    parser.add_argument("--language", default="en")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    for path in options.audio:
        choice = Options(transcript=options.transcript, language=options.language)
        track = track_from_audio(path, choice, lambda stage, done: None)
        draw(path, track, options.out / f"{path.stem}.png")
        print(f"{path.stem}: lip opening and loudness correlate by {loudness_correlation(path, track):.2f}")


if __name__ == "__main__":
    main()
