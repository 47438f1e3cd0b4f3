"""Arguments to exit codes: 0 done, 2 the user's input or options are at fault, 1 anything else."""

from __future__ import annotations

import argparse
import importlib
import sys

from vectortalker.errors import ErrorCode, VectorTalkerError

COMMANDS = ("vectorize", "landmarks", "speech", "animate", "talk", "batch", "serve", "worker")
OURS: tuple[ErrorCode, ...] = ("internal", "storage_full", "queue_full", "unavailable")  # not the user's fault
INTERRUPTED = 130  # 128 + SIGINT, as shells have it


class _Parser(argparse.ArgumentParser):
    """One line for a wrong option, without the usage text."""

    def error(self, message: str) -> None:  # type: ignore[override]  # argparse annotates NoReturn; exit() is it
        self.exit(2, f"{self.prog}: {message}\n")


def main(arguments: list[str] | None = None) -> int:
    """Run one command; its exit code."""
    parser = _Parser(prog="vectortalker", description="Portraits of any style become layered SVGs that talk.")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    for name in COMMANDS:
        module = importlib.import_module(f"vectortalker.cli.{name}")
        command = commands.add_parser(name, help=module.__doc__, description=module.__doc__)
        module.add_arguments(command)
        command.set_defaults(run=module.run)
    commands.add_parser("bench", help="Print the benchmark tables.", add_help=False)
    arguments = sys.argv[1:] if arguments is None else arguments
    if arguments[:1] == ["bench"]:
        return _bench(arguments[1:])
    options = parser.parse_args(arguments)
    try:
        return options.run(options) or 0
    except VectorTalkerError as error:
        print(f"vectortalker: {error.message}", file=sys.stderr)
        return 1 if error.code in OURS else 2
    except KeyboardInterrupt:
        print("vectortalker: interrupted", file=sys.stderr)
        return INTERRUPTED


def _bench(arguments: list[str]) -> int:
    """The benchmarks have a parser of their own."""
    from vectortalker.bench.__main__ import main as bench

    return bench(arguments)
