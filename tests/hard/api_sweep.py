"""Every file of the hard set through the HTTP API of a real server; writes the column "API" of docs/robustness.md.

Run by hand after `tests/hard/sweep.py`, with the development data beside the repository:
`.venv/bin/python -m tests.hard.api_sweep [NAME…]`. A file ends well with a picture, or with one sentence and a status
of the 4xx that says why there is none, within the limits of time and memory that the sweep of the command line has.
"""

from __future__ import annotations

import re
import sys
import tempfile
import time
from collections.abc import Mapping
from pathlib import Path

import httpx

from tests.hard.sweep import LIMIT_MEGABYTES, LIMIT_SECONDS, REPOSITORY, SHARED
from tests.server.conftest import Serving

SMALL = {"paths": 32, "levels": 1, "final_iterations": 10, "working_size": 128}
TABLES = REPOSITORY / "docs" / "robustness.md"
COLUMN = "API"
ENDED = ("done", "failed", "cancelled")
POLL_SECONDS = 0.1


def outcome(client: httpx.Client, path: Path) -> str:
    """Upload, faces, job, SVG; the first refusal, or what there is in the end."""
    upload = client.post("/api/portraits", files={"file": (path.name, path.read_bytes())})
    if upload.status_code != 201:
        return _refusal(upload)
    portrait_id = upload.json()["id"]
    faces = client.get(f"/api/portraits/{portrait_id}/faces")
    if faces.status_code != 200:
        return _refusal(faces)
    found = faces.json()["faces"]
    landmarks = found[0]["landmarks"] if found else None
    body = {"portrait_id": portrait_id, "landmarks": landmarks, "options": SMALL}
    job = client.post("/api/jobs", json=body).json()
    while job["phase"] not in ENDED:
        time.sleep(POLL_SECONDS)
        job = client.get(f"/api/jobs/{job['id']}").json()
    svg = client.get(f"/api/jobs/{job['id']}/svg")
    client.delete(f"/api/portraits/{portrait_id}")
    if job["phase"] != "done" or not svg.text.startswith("<svg"):
        return f"FAILED: {job['phase']} {job['error']}"
    return f"{len(found)} faces, done"


def _refusal(answer: httpx.Response) -> str:
    message = answer.json()["message"]
    return (
        f"{answer.status_code}: {message}"
        if 400 <= answer.status_code < 500
        else f"FAILED: {answer.status_code} {message}"
    )


def processes(root: int) -> list[int]:
    """A process and its children."""
    children = [path.read_text() for path in Path(f"/proc/{root}/task").glob("*/children")]
    return [root, *(int(pid) for text in children for pid in text.split())]


def peak_megabytes(pids: list[int]) -> float:
    """The most that any of them held since the last call."""
    peaks = [re.search(r"VmHWM:\s+(\d+) kB", Path(f"/proc/{pid}/status").read_text()) for pid in pids]
    for pid in pids:
        Path(f"/proc/{pid}/clear_refs").write_text("5")  # resets the high-water mark
    return max(int(peak.group(1)) for peak in peaks if peak) / 1000


def with_column(markdown: str, outcomes: Mapping[str, str]) -> str:
    """The tables of files with `COLUMN` as their last cell, or filled in where they have it."""
    lines, column = [], None
    for line in markdown.split("\n"):
        cells = re.split(r"(?<!\\)\|", line[1:-1]) if line.startswith("|") else []
        if not cells:
            column = None
        elif cells[0].strip() == "file":
            column = next((i for i, cell in enumerate(cells) if cell.strip() == COLUMN), len(cells))
        if column is not None:
            cells[column : column + 1] = [_cell(cells, column, outcomes)]
            line = f"|{'|'.join(cells)}|"
        lines.append(line)
    return "\n".join(lines)


def _cell(cells: list[str], column: int, outcomes: Mapping[str, str]) -> str:
    """What was said in another cell is not said again; a file that was not tried keeps what it had."""
    name = cells[0].strip()
    if name == "file":
        return f" {COLUMN} "
    if set(name) == {"-"}:
        return "---"
    text = outcomes.get(name, "").replace("|", r"\|")
    for cell in cells[1:column]:
        if cell.strip().startswith(name):
            text = text.replace(cell.strip(), "the same")
    kept = cells[column] if column < len(cells) else " "
    return f" {text} " if text else kept


def main() -> int:
    wanted = sys.argv[1:]
    outcomes = {}
    with tempfile.TemporaryDirectory() as folder:
        serving = Serving(Path(folder), "--cache-mb", "0")
        serving.client.timeout = httpx.Timeout(LIMIT_SECONDS)
        for path in sorted((SHARED / "data" / "hard").iterdir()):
            if wanted and not any(part in path.name for part in wanted):
                continue
            pids = processes(serving.process.pid)
            peak_megabytes(pids)
            began = time.monotonic()
            said = outcome(serving.client, path)
            seconds, megabytes = time.monotonic() - began, peak_megabytes(pids)
            limited = seconds < LIMIT_SECONDS and megabytes < LIMIT_MEGABYTES
            outcomes[path.name] = (
                f"{said}; {megabytes:.0f} MB" if limited else f"FAILED: {seconds:.0f} s, {megabytes:.0f} MB"
            )
            print(f"{path.name}: {outcomes[path.name]}, {seconds:.1f} s", flush=True)
        serving.stop()
    TABLES.write_text(with_column(TABLES.read_text(encoding="utf-8"), outcomes), encoding="utf-8")
    return 1 if any(text.startswith("FAILED") for text in outcomes.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
