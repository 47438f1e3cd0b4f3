"""The command line. Each command is a module that is imported only when it runs: torch alone takes seconds."""

from vectortalker.cli.main import main

__all__ = ["main"]
