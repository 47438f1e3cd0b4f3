"""A progress bar on stderr."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskID, TextColumn, TimeElapsedColumn, TimeRemainingColumn


@dataclass(frozen=True)
class Bar:
    _progress: Progress
    _task: TaskID

    def show(self, stage: str, fraction: float) -> None:
        self._progress.update(self._task, stage=stage, completed=fraction)


@contextmanager
def progress_bar(name: str) -> Iterator[Bar]:
    """Redrawn in a terminal; elsewhere written once, at its end. Gone if the block fails: the fault stands alone."""
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        TextColumn("{task.percentage:>3.0f} %"),
        TextColumn("{task.fields[stage]}"),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
    )
    progress = Progress(*columns, console=Console(stderr=True))
    progress.start()
    try:
        yield Bar(progress, progress.add_task(name, total=1, stage=""))
    except BaseException:
        progress.live.transient = True
        progress.disable = not progress.console.is_terminal
        raise
    finally:
        progress.stop()
