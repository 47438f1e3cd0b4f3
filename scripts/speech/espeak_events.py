"""Speaks lines with libespeak-ng and tells when each phone begins: the truth of the training corpus.

A program of its own, run as a separate process, because espeak-ng is under the GPL and the package is not.
Input: one JSON object a line, `{"voice", "text", "rate", "pitch", "range"}` (words a minute, 0…100, 0…100).
Output: one pickled `(rate, samples int16, [(start_seconds, ipa)])` each, until the input ends.
"""

from __future__ import annotations

import ctypes
import json
import pickle
import sys

import numpy as np

AUDIO_OUTPUT_RETRIEVAL = 1
PHONEME_EVENTS_IPA = 3
POS_CHARACTER, CHARS_UTF8 = 1, 1
RATE, PITCH, RANGE = 1, 3, 4  # espeak_PARAMETER
LIST_TERMINATED, PHONEME = 0, 7  # espeak_EVENT_TYPE


class EventId(ctypes.Union):
    _fields_ = [
        ("number", ctypes.c_int),
        ("name", ctypes.c_char_p),
        ("string", ctypes.c_char * 8),
    ]


class Event(ctypes.Structure):
    """espeak_EVENT of speak_lib.h."""

    _fields_ = [
        ("type", ctypes.c_int),
        ("unique_identifier", ctypes.c_uint),
        ("text_position", ctypes.c_int),
        ("length", ctypes.c_int),
        ("audio_position", ctypes.c_int),
        ("sample", ctypes.c_int),
        ("user_data", ctypes.c_void_p),
        ("id", EventId),
    ]


CALLBACK = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.POINTER(ctypes.c_short), ctypes.c_int, ctypes.POINTER(Event))


class Synthesiser:
    def __init__(self) -> None:
        self._library = ctypes.CDLL("libespeak-ng.so.1")
        self.rate = self._library.espeak_Initialize(AUDIO_OUTPUT_RETRIEVAL, 0, None, PHONEME_EVENTS_IPA)
        self._samples: list[np.ndarray] = []
        self._phones: list[tuple[float, str]] = []
        self._callback = CALLBACK(self._collect)  # kept: the library holds the bare pointer
        self._library.espeak_SetSynthCallback(self._callback)

    def speak(self, voice: str, text: str, rate: int, pitch: int, pitch_range: int) -> tuple[np.ndarray, list]:
        """Raises ValueError for a voice that is not installed."""
        if self._library.espeak_SetVoiceByName(voice.encode()) != 0:
            raise ValueError(f"espeak-ng has no voice {voice}")
        for parameter, value in ((RATE, rate), (PITCH, pitch), (RANGE, pitch_range)):
            self._library.espeak_SetParameter(parameter, value, 0)
        self._samples, self._phones = [np.empty(0, np.int16)], []
        data = text.encode() + b"\0"
        self._library.espeak_Synth(data, len(data), 0, POS_CHARACTER, 0, CHARS_UTF8, None, None)
        self._library.espeak_Synchronize()
        return np.concatenate(self._samples), self._phones

    def _collect(self, samples, n_samples, events) -> int:
        if samples and n_samples > 0:
            self._samples.append(np.ctypeslib.as_array(samples, (n_samples,)).copy())
        index = 0
        while events[index].type != LIST_TERMINATED:
            event = events[index]
            if event.type == PHONEME:
                raw = ctypes.string_at(ctypes.addressof(event.id), 8).split(b"\0")[0]
                self._phones.append((event.audio_position / 1000, raw.decode("utf-8", "ignore")))
            index += 1
        return 0


def main() -> None:
    synthesiser = Synthesiser()
    for line in sys.stdin:
        wish = json.loads(line)
        samples, phones = synthesiser.speak(wish["voice"], wish["text"], wish["rate"], wish["pitch"], wish["range"])
        pickle.dump((synthesiser.rate, samples, phones), sys.stdout.buffer)
        sys.stdout.buffer.flush()


if __name__ == "__main__":
    main()
