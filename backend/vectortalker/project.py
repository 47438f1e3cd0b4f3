"""A project file `.vtalk` becomes a `Project` with its picture and sound, and back.

It is a zip of `project.json` and the files that it names as `source` and `audio`. All that is read comes from
strangers: sizes are limited before and while unpacking, names are names and never paths, newer versions are refused.
"""

from __future__ import annotations

import io
import zipfile
import zlib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from vectortalker.errors import VectorTalkerError
from vectortalker.json_input import parse_json, sentence
from vectortalker.schema import SCHEMA_VERSION, Project

DOCUMENT = "project.json"
MAX_FILE_BYTES = 128_000_000
MAX_DOCUMENT_BYTES = 64_000_000  # a fine scene has 2 MB, an hour's track 30 MB
MAX_MEDIA_BYTES = 64_000_000
MAX_ENTRIES = 64  # a directory of millions would be read whole before any entry
ENTRY_SIGNATURE = b"PK\x01\x02"
MAX_REASON = 100  # characters
FIXED_DATE = (1980, 1, 1, 0, 0, 0)  # same project, same bytes
DAMAGED = (zipfile.BadZipFile, zlib.error, EOFError, OSError, RuntimeError, NotImplementedError, ValueError)

Migration = Callable[[dict[str, Any]], dict[str, Any]]
MIGRATIONS: dict[int, Migration] = {}  # document of version n to one of version n + 1


@dataclass(frozen=True)
class ProjectFile:
    """The document and the bytes of `project.source` and `project.audio`, which are there if they are named."""

    project: Project
    source: bytes | None = None
    audio: bytes | None = None


def pack(file: ProjectFile) -> bytes:
    """The zip. Media are compressed already and only stored."""
    project = file.project
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w") as entries:
        document = project.model_dump_json().encode()
        entries.writestr(_entry(DOCUMENT), document, zipfile.ZIP_DEFLATED)
        for name, data in ((project.source, file.source), (project.audio, file.audio)):
            assert (name is None) == (data is None), name
            if name is not None and data is not None:
                entries.writestr(_entry(name), data, zipfile.ZIP_STORED)
    return archive.getvalue()


def unpack(data: bytes, name: str) -> ProjectFile:
    """Raises `bad_project`: no such zip, too large, damaged, of a newer version, or of content that is not allowed."""
    if len(data) > MAX_FILE_BYTES:
        raise _bad(f"{name} has {len(data) / 1e6:.0f} MB; the limit is {MAX_FILE_BYTES / 1e6:.0f} MB.")
    if data.count(ENTRY_SIGNATURE) > MAX_ENTRIES:
        raise _bad(f"{name} has more than {MAX_ENTRIES} entries, which is the limit.")
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as entries:
            project = _validated(_migrated(_document(entries, name), name), name)
            source = _media(entries, project.source, name)
            audio = _media(entries, project.audio, name)
    except DAMAGED as error:
        reason = str(error)[:MAX_REASON]  # it may quote a name of 64 kB
        raise _bad(f"{name} is not a whole project file ({reason}): save it again.") from error
    return ProjectFile(project, source, audio)


def _entry(name: str) -> zipfile.ZipInfo:
    return zipfile.ZipInfo(name, FIXED_DATE)


def _document(entries: zipfile.ZipFile, name: str) -> dict[str, Any]:
    document = parse_json(_read(entries, DOCUMENT, MAX_DOCUMENT_BYTES, name), "bad_project", f"{DOCUMENT} of {name}")
    if not isinstance(document, dict):
        raise _bad(f"{DOCUMENT} of {name} is not an object: save the project again.")
    return document


def _migrated(document: dict[str, Any], name: str) -> dict[str, Any]:
    version = document.get("schema_version")
    if not isinstance(version, int) or version < 1:
        raise _bad(f"{name} has no valid schema_version ({version!r:.40}).")
    if version > SCHEMA_VERSION:
        raise _bad(
            f"{name} was saved by a newer VectorTalker (project version {version}; this one reads up to"
            f" {SCHEMA_VERSION}): update VectorTalker."
        )
    for step in range(version, SCHEMA_VERSION):
        document = MIGRATIONS[step](document)
    return document


def _validated(document: dict[str, Any], name: str) -> Project:
    try:
        return Project.model_validate(document)
    except ValidationError as error:
        raise _bad(f"{name} is not a valid project: {sentence(error)}") from error


def _media(entries: zipfile.ZipFile, entry: str | None, name: str) -> bytes | None:
    if entry is None:
        return None
    if not entry or Path(entry).name != entry or "\\" in entry or entry in (DOCUMENT, ".", ".."):
        raise _bad(f"{name} names {entry[:60]!r}, which is no plain file name.")
    return _read(entries, entry, MAX_MEDIA_BYTES, name)


def _read(entries: zipfile.ZipFile, entry: str, max_bytes: int, name: str) -> bytes:
    """At most `max_bytes` are ever unpacked, whatever the directory of the zip says."""
    try:
        with entries.open(entry) as file:
            data = file.read(max_bytes + 1)
    except KeyError as error:
        raise _bad(f"{name} holds no {entry[:60]}: save the project again.") from error
    if len(data) > max_bytes:
        raise _bad(f"{entry[:60]} of {name} has more than {max_bytes / 1e6:.0f} MB, which is the limit.")
    return data


def _bad(message: str) -> VectorTalkerError:
    return VectorTalkerError("bad_project", message)
