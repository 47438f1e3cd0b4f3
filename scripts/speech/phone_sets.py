"""Turns the phone names of flite, Festival and pocketsphinx into IPA."""

from __future__ import annotations

RADIO = {  # ARPAbet in lower case: flite, pocketsphinx and the English voices of Festival
    "aa": "ɑ", "ae": "æ", "ah": "ʌ", "ao": "ɔ", "aw": "aʊ", "ax": "ə", "axr": "ɚ", "ay": "aɪ", "b": "b", "ch": "tʃ",
    "d": "d", "dh": "ð", "dx": "ɾ", "eh": "ɛ", "el": "l", "em": "m", "en": "n", "er": "ɝ", "ey": "eɪ", "f": "f",
    "g": "ɡ", "hh": "h", "hv": "h", "ih": "ɪ", "iy": "i", "jh": "dʒ", "k": "k", "l": "l", "m": "m", "n": "n",
    "nx": "n", "ng": "ŋ", "ow": "oʊ", "oy": "ɔɪ", "p": "p", "r": "ɹ", "s": "s", "sh": "ʃ", "t": "t", "th": "θ",
    "uh": "ʊ", "uw": "u", "v": "v", "w": "w", "y": "j", "z": "z", "zh": "ʒ",
}  # fmt: skip
ROMANCE = {  # SAMPA of the Italian and Catalan voices; stress is a final 1
    **{letter: letter for letter in "abdefgijklmnopstuvwz"},
    "r": "r", "E": "ɛ", "O": "ɔ", "S": "ʃ", "Z": "ʒ", "tS": "tʃ", "dZ": "dʒ", "ts": "ts", "dz": "dz", "J": "ɲ",
    "L": "ʎ", "ng": "ŋ", "ax": "ə", "rr": "r", "uw": "w", "y": "j", "N": "ŋ", "nf": "ɱ",
}  # fmt: skip
FINNISH = {
    **{letter: letter for letter in "abdefghijklmnoprstuvyz"},
    "@": "æ", "7": "ø", "N": "ŋ", "S": "ʃ", "Z": "ʒ", "w": "w", "T": "θ",
}  # fmt: skip
CZECH = {
    **{letter: letter for letter in "abdefgijklmnoprstuvxz"},
    "h": "ɦ", "c": "ts", "c~": "tʃ", "d~": "ɟ", "t~": "c", "n~": "ɲ", "r~": "r", "s~": "ʃ", "z~": "ʒ", "N": "ŋ",
    "dz": "dz", "dz~": "dʒ", "ou": "oʊ", "au": "aʊ", "eu": "eʊ", "ch": "x", "@": "ə",
}  # fmt: skip
HINDI = {
    **{letter: letter for letter in "fkgnpbmrlshx"},
    "a": "ʌ", "aa": "ɑ", "ih": "ɪ", "iy": "i", "uh": "ʊ", "uw": "u", "eh": "e", "ee": "e", "ay": "ɛ", "oh": "o",
    "oo": "o", "aw": "ɔ", "@": "ə", "T": "ʈ", "D": "ɖ", "N": "ɳ", "L": "ɭ", "R": "ɽ", "th": "t", "dh": "d", "td": "ʈ",
    "tth": "t", "ddh": "d", "kh": "k", "gh": "ɡ", "bh": "b", "ch": "tʃ", "j": "dʒ", "y": "j", "v": "ʋ", "w": "w",
    "sh": "ʃ", "zh": "ʒ", "ksh": "kʃ", "sri": "ʃri",
}  # fmt: skip
RUSSIAN = {  # doubled vowels are stressed, doubled consonants soft
    **{letter: letter for letter in "abdefgijklmnoprstuvz"},
    "y": "ɨ", "h": "x", "c": "ts", "ch": "tʃ", "sh": "ʃ", "sch": "ɕ", "zh": "ʒ", "ae": "ə", "ay": "ə", "ur": "u",
    "yy": "ɨ", "hh": "x", **{2 * letter: letter for letter in "abdefgiklmnoprstuvz"},
}  # fmt: skip
SILENCES = {"pau", "#", "##", "_", "h#", "sil", "SIL", "ssil", "brth", "+spn+", "+nsn+"}


def ipa(phone: str, table: dict[str, str]) -> str:
    """IPA of `phone`, empty for a pause. Raises KeyError for a phone that the table lacks."""
    if phone in SILENCES:
        return ""
    return table[phone] if phone in table else table[phone.rstrip("1:0*")]
