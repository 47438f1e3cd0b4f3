"""Turns lines of text into speech whose phone times are exactly known, by three synthesisers that run as processes."""

from __future__ import annotations

import json
import pickle
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from phone_sets import CZECH, FINNISH, HINDI, RADIO, ROMANCE, RUSSIAN, ipa
from scipy.io import wavfile
from vectortalker.speech.visemes import Block, blocks_of_phones

Phones = list[tuple[float, float, str]]  # start, end (seconds), IPA; empty IPA: a pause

FESTIVAL_VOICES = {  # voice: language of the sentences, phone set, encoding that Festival reads
    "kal_diphone": ("en", RADIO, "ascii"),
    "ked_diphone": ("en", RADIO, "ascii"),
    "cmu_us_slt_arctic_hts": ("en", RADIO, "ascii"),
    "upc_ca_ona_hts": ("ca", ROMANCE, "iso-8859-1"),
    "lp_diphone": ("it", ROMANCE, "iso-8859-1"),
    "hy_fi_mv_diphone": ("fi", FINNISH, "iso-8859-1"),
    "suo_fi_lj_diphone": ("fi", FINNISH, "iso-8859-1"),
    "czech_dita": ("cs", CZECH, "iso-8859-2"),
    "czech_krb": ("cs", CZECH, "iso-8859-2"),
    "czech_ph": ("cs", CZECH, "iso-8859-2"),
    "czech_machac": ("cs", CZECH, "iso-8859-2"),
    "hindi_NSK_diphone": ("hi", HINDI, "utf-8"),
    "msu_ru_nsh_clunits": ("ru", RUSSIAN, "utf-8"),
}
GAP_LEVEL = 10 ** (-50 / 20)  # of the peak: voiced closures are at -30 dB, espeak-ng's voiceless ones below -80 dB
GAP_SECONDS = (0.008, 0.15)  # least and greatest length of a closure
_DUMP = """(define (phones utt) (mapcar (lambda (s) (format t "%s %f|" (item.name s) (item.feat s "end")))
  (utt.relation.items utt 'Segment)) (format t "\\n"))
"""
_LANGUAGE_SWITCH = re.compile(r"\([a-z-]+\)")


@dataclass(frozen=True)
class Utterance:
    """Samples [n] within -1…1 at `rate` Hz."""

    voice: str
    language: str
    text: str
    rate: int
    samples: np.ndarray
    blocks: list[Block]


@dataclass(frozen=True)
class EspeakWish:
    """Rate in words a minute, pitch and range 0…100."""

    language: str
    variant: str
    text: str
    rate: int
    pitch: int
    range: int


def espeak(wishes: Iterator[EspeakWish]) -> Iterator[Utterance]:
    program = Path(__file__).with_name("espeak_events.py")
    process = subprocess.Popen([sys.executable, str(program)], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert process.stdin and process.stdout
    for wish in wishes:
        voice = f"{wish.language}+{wish.variant}" if wish.variant else wish.language
        line = {
            "voice": voice,
            "text": wish.text,
            "rate": wish.rate,
            "pitch": wish.pitch,
            "range": wish.range,
        }
        process.stdin.write(json.dumps(line).encode() + b"\n")
        process.stdin.flush()
        rate, samples, events = pickle.load(process.stdout)
        ends = [*(start for start, _ in events[1:]), len(samples) / rate]
        phones = [
            (start, end, _LANGUAGE_SWITCH.sub("", name)) for (start, name), end in zip(events, ends, strict=False)
        ]
        heard = samples / np.float32(32768)
        blocks = blocks_of_phones(with_closures(phones, heard, rate))
        yield Utterance(f"espeak {voice}", wish.language, wish.text, rate, heard, blocks)
    process.stdin.close()
    process.wait()


def with_closures(phones: Phones, samples: np.ndarray, rate: int) -> Phones:
    """espeak-ng tells of a voiceless stop at its release: the silent closure before it is part of the stop, too.

    Other synthesisers, and phoneticians, count it so. After a pause nothing shows where the closure begins.
    """
    is_loud = np.abs(samples) > GAP_LEVEL * np.abs(samples).max(initial=0)
    starts = [start for start, _, _ in phones]
    for index in range(1, len(phones)):
        release, named = phones[index][0], phones[index][2] and phones[index - 1][2]
        end = round(release * rate)
        first = max(0, end - round(GAP_SECONDS[1] * rate))
        before = np.flatnonzero(is_loud[first:end])
        gap = (end - first - int(before[-1]) - 1) / rate if len(before) else 0.0
        if named and gap > GAP_SECONDS[0]:
            starts[index] = max(starts[index - 1], release - gap)
    ends = [*starts[1:], phones[-1][1]] if phones else []
    return [(start, end, name) for (_, _, name), start, end in zip(phones, starts, ends, strict=True)]


def flite(voice: str, text: str) -> Utterance:
    with tempfile.NamedTemporaryFile(suffix=".wav") as file:
        command = ["flite", "-voice", voice, "-t", text, "-psdur", "-o", file.name]
        told = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        rate, samples = wavfile.read(file.name)
    ends = [item.rsplit(":", 1) for item in told.split()]
    return Utterance(f"flite {voice}", "en", text, rate, samples / np.float32(32768), _blocks(ends, RADIO))


def festival(voice: str, texts: list[str]) -> list[Utterance]:
    language, table, encoding = FESTIVAL_VOICES[voice]
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "speak.scm"
        lines = [_DUMP, f"(voice_{voice})"]
        for index, text in enumerate(texts):
            spoken = text.replace('"', " ")
            lines.append(f'(set! u (utt.synth (Utterance Text "{spoken}"))) (phones u)')
            lines.append(f'(utt.save.wave u "{folder}/{index}.wav" \'riff)')
        script.write_bytes("\n".join(lines).encode(encoding, "replace"))
        told = subprocess.run(["festival", "-b", str(script)], check=True, capture_output=True, text=True).stdout
        utterances = []
        for index, row in enumerate(row for row in told.splitlines() if "|" in row):
            rate, samples = wavfile.read(f"{folder}/{index}.wav")
            ends = [item.split() for item in row.strip("|").split("|")]
            blocks = _blocks(ends, table)
            heard = samples / np.float32(32768)
            utterances.append(Utterance(f"festival {voice}", language, texts[index], rate, heard, blocks))
    return utterances


def _blocks(ends: list[list[str]], table: dict[str, str]) -> list[Block]:
    times = [float(end) for _, end in ends]
    return blocks_of_phones(
        (start, end, ipa(name, table)) for (name, _), start, end in zip(ends, [0.0, *times], times, strict=False)
    )
