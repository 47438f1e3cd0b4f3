"""Project files: the round trip, and all that strangers may put into a zip."""

from __future__ import annotations

import io
import json
import zipfile
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from vectortalker import project as projects
from vectortalker.errors import VectorTalkerError
from vectortalker.project import ProjectFile, pack, unpack

from .documents import project

MEDIA = {"source": "source.png", "audio": "voice.wav"}


def packed(entries: dict[str, bytes], method: int = zipfile.ZIP_DEFLATED) -> bytes:
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w", method) as file:
        for name, data in entries.items():
            file.writestr(name, data)
    return archive.getvalue()


def document(**changes: Any) -> bytes:
    return json.dumps({**json.loads(project().model_dump_json()), **changes}).encode()


def refusal(data: bytes) -> str:
    with pytest.raises(VectorTalkerError) as caught:
        unpack(data, "face.vtalk")
    assert caught.value.code == "bad_project"
    assert "face.vtalk" in caught.value.message
    return caught.value.message


def test_project_round_trip() -> None:
    file = ProjectFile(project().model_copy(update=MEDIA), b"picture", b"sound")
    assert unpack(pack(file), "face.vtalk") == file


def test_same_project_gives_the_same_bytes() -> None:
    assert pack(ProjectFile(project())) == pack(ProjectFile(project()))


def test_newer_version_is_refused_by_name() -> None:
    assert "project version 7; this one reads up to 1" in refusal(packed({"project.json": document(schema_version=7)}))


def test_older_version_is_migrated(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(projects, "SCHEMA_VERSION", 3)
    steps = {1: lambda old: {**old, "name": old["name"] + "+"}, 2: lambda old: {**old, "schema_version": 1}}
    monkeypatch.setattr(projects, "MIGRATIONS", steps)
    assert unpack(packed({"project.json": document()}), "face.vtalk").project.name == "Ada+"


@pytest.mark.parametrize(
    ("entries", "words"),
    [
        ({}, "holds no project.json"),
        ({"project.json": b"[]"}, "not an object"),
        ({"project.json": b"{"}, "not JSON"),
        ({"project.json": b"[" * 200_000}, "nested too deeply"),
        ({"project.json": document(schema_version="1")}, "schema_version"),
        ({"project.json": document(name=3)}, "name"),
        ({"project.json": document(scene={})}, "scene"),
        ({"project.json": document().replace(b"100.0", b"NaN")}, "NaN"),
        ({"project.json": document().replace(b"100.0", b"1e999")}, "width"),
        ({"project.json": document(source="gone.png")}, "holds no gone.png"),
    ],
)
def test_project_at_fault_is_explained(entries: dict[str, bytes], words: str) -> None:
    assert words in refusal(packed(entries))


@pytest.mark.parametrize("name", ["../secret", "/etc/passwd", "a/b.png", "a\\b.png", "..", "", "project.json"])
def test_media_name_is_no_path(name: str) -> None:
    assert "no plain file name" in refusal(packed({"project.json": document(source=name), "a/b.png": b"x"}))


def test_bomb_is_unpacked_no_further_than_its_limit(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(projects, "MAX_MEDIA_BYTES", 10_000)
    bomb = packed({"project.json": document(source="bomb.png"), "bomb.png": bytes(30_000_000)})
    assert len(bomb) < 100_000
    assert "limit" in refusal(bomb)


def test_directory_of_too_many_entries_is_not_read() -> None:
    assert "64 entries" in refusal(packed({f"{i}": b"" for i in range(100)}, zipfile.ZIP_STORED))


@pytest.mark.parametrize("data", [b"", b"PK", b"hello" * 100, pack(ProjectFile(project()))[:-30]])
def test_what_is_no_zip_is_refused(data: bytes) -> None:
    assert "not a whole project file" in refusal(data)


def test_refusal_quotes_no_more_than_a_line() -> None:
    """A local header whose length of name swallows what follows, and so differs from the directory's name."""
    whole = bytearray(pack(ProjectFile(project())))
    whole[26:28] = (600).to_bytes(2, "little")
    assert len(refusal(bytes(whole))) < 250


@settings(max_examples=300, deadline=None)
@given(st.data())
def test_damaged_project_is_read_or_refused(data: st.DataObject) -> None:
    """Property: any few changed bytes give a project or a `bad_project`, nothing else."""
    whole = bytearray(pack(ProjectFile(project().model_copy(update=MEDIA), b"picture", b"sound")))
    for position in data.draw(st.lists(st.integers(0, len(whole) - 1), min_size=1, max_size=4)):
        whole[position] = data.draw(st.integers(0, 255))
    try:
        unpack(bytes(whole), "face.vtalk")
    except VectorTalkerError as error:
        assert error.code == "bad_project"
