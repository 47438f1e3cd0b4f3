"""Every file of the hard set through the command line, one process each; writes docs/robustness.md.

Run by hand, with the development data beside the repository: `.venv/bin/python tests/hard/sweep.py`. The processes are
forked from this one, so that the libraries are loaded once.
"""

from __future__ import annotations

import contextlib
import json
import os
import signal
import sys
import tempfile
import time
import traceback
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

from vectortalker import landmarks, vectorize  # noqa: F401  # loaded before forking
from vectortalker.cli import main as command_line
from vectortalker.project import unpack

REPOSITORY = Path(__file__).parents[2]
SHARED = Path(os.environ.get("VECTORTALKER_SHARED", REPOSITORY.parent / "shared"))
SMALL = ["--paths", "32", "--levels", "1", "--final-iterations", "10", "--working-size", "128"]
LIMIT_SECONDS = 120
LIMIT_MEGABYTES = 2000
BY_HAND = "\n## The server"  # what follows in the document is not made here


@dataclass(frozen=True)
class Outcome:
    name: str
    exit_code: int
    stderr: str
    seconds: float
    megabytes: float  # most memory held at once
    has_face: bool
    psnr: float | None

    @property
    def is_sensible(self) -> bool:
        """A result, or one clear line and exit code 2; in time, within memory, without a traceback."""
        said = self.exit_code == 0 or (self.exit_code == 2 and self.stderr.count("\n") == 1)
        within = self.seconds < LIMIT_SECONDS and self.megabytes < LIMIT_MEGABYTES
        return said and within and "Traceback" not in self.stderr


def sweep(folder: Path) -> Iterable[Outcome]:
    for path in sorted(folder.iterdir()):
        with tempfile.TemporaryDirectory() as out:
            yield _outcome(path, Path(out))


def _outcome(path: Path, out: Path) -> Outcome:
    began = time.monotonic()
    child = os.fork()
    if child == 0:
        _run(path, out)
    _, status, usage = os.wait4(child, 0)
    stderr = (out / "stderr").read_text()
    project, metrics = out / "out.vtalk", out / "metrics.json"
    return Outcome(
        name=path.name,
        exit_code=os.waitstatus_to_exitcode(status),
        stderr=stderr.replace(f"{path.parent}/", ""),
        seconds=time.monotonic() - began,
        megabytes=usage.ru_maxrss / 1000,
        has_face=project.exists() and unpack(project.read_bytes(), project.name).project.landmarks is not None,
        psnr=json.loads(metrics.read_text())["psnr"] if metrics.exists() else None,
    )


def _run(path: Path, out: Path) -> NoReturn:
    """The command in this process, which ends with it, after `LIMIT_SECONDS` at the latest."""
    signal.alarm(LIMIT_SECONDS)
    files = ["-o", out / "out.svg", "--project", out / "out.vtalk", "--metrics", out / "metrics.json"]
    with (out / "stderr").open("w") as stderr, contextlib.redirect_stderr(stderr):
        try:
            code = command_line([str(argument) for argument in ["vectorize", path, *files, *SMALL]])
        except Exception:  # as the interpreter would
            traceback.print_exc()
            code = 1
    os._exit(code)


def report(outcomes: list[Outcome]) -> str:
    """Markdown: refused files with their message, the rest with what came out."""
    refused = [outcome for outcome in outcomes if outcome.exit_code != 0]
    done = [outcome for outcome in outcomes if outcome.exit_code == 0]
    odd = [outcome.name for outcome in outcomes if not outcome.is_sensible]
    lines = [
        "# Robustness",
        "",
        f"{len(outcomes)} hard files, each by a process of `vectortalker vectorize {' '.join(SMALL)}`",
        f"(`tests/hard/sweep.py`): {len(done)} give a picture, {len(refused)} are refused. Files that give neither a",
        f"picture nor exit code 2 with one line, or take more than {LIMIT_SECONDS} s or {LIMIT_MEGABYTES} MB:",
        f"{', '.join(odd) or 'none'}.",
        "",
        "Few paths keep the sweep short: PSNR here is a sign of life, no measure of quality. Seconds are wall time on",
        "two cores that were busy with other work; memory is the most that the process held.",
        "",
        "The column *browser*, added by `node tests/hard/browser_sweep.mjs`, says what the editor gives when the file",
        "is dropped into it: a draft kept at its first picture, or one sentence.",
        "",
        "## Refused",
        "",
        "| file | message | s | MB |",
        "|---|---|---|---|",
        *(f"| {o.name} | {_message(o)} | {o.seconds:.1f} | {o.megabytes:.0f} |" for o in refused),
        "",
        "## Vectorised",
        "",
        "| file | face | PSNR, dB | s | MB |",
        "|---|---|---|---|---|",
        *(
            f"| {o.name} | {'found' if o.has_face else 'none'} | {o.psnr:.1f} | {o.seconds:.1f} | {o.megabytes:.0f} |"
            for o in done
        ),
    ]
    return "\n".join(lines) + "\n"


def _message(outcome: Outcome) -> str:
    return outcome.stderr.strip().removeprefix("vectortalker: ").replace("|", "\\|")


def main() -> int:
    outcomes = []
    for outcome in sweep(SHARED / "data" / "hard"):
        mark = "" if outcome.is_sensible else "  ← not sensible"
        print(
            f"{outcome.name}: {outcome.exit_code}, {outcome.seconds:.1f} s, {outcome.megabytes:.0f} MB{mark}",
            flush=True,
        )
        if not outcome.is_sensible:
            print(outcome.stderr, flush=True)
        outcomes.append(outcome)
    document = REPOSITORY / "docs" / "robustness.md"
    before = document.read_text(encoding="utf-8")
    document.write_text(report(outcomes) + before[before.index(BY_HAND) :], encoding="utf-8")
    return 0 if all(outcome.is_sensible for outcome in outcomes) else 1


if __name__ == "__main__":
    sys.exit(main())
