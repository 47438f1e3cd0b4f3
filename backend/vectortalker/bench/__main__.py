"""`python -m vectortalker.bench`: prints the tables and writes them, their rows and contact sheets to a folder."""

from __future__ import annotations

import argparse
import platform
import sys
from pathlib import Path

from vectortalker.bench.ledger import keep, kept
from vectortalker.bench.lpips import Lpips, load_lpips
from vectortalker.bench.measure import Run, run_recipe, run_tracer
from vectortalker.bench.portraits import Sitter, portrait_files, portrait_folder, sitters
from vectortalker.bench.posed import posed_table
from vectortalker.bench.sheets import contact_sheet
from vectortalker.bench.tables import means, side_by_side
from vectortalker.bench.tracers import TRACERS, available
from vectortalker.bench.unsplit import unsplit_table
from vectortalker.schema import VectorizeOptions

TABLES: dict[str, tuple[str, dict[str, VectorizeOptions]]] = {
    "recipes": (
        "Recipes at 500 paths × 8 cubics, 512 px",
        {
            "best": VectorizeOptions(recipe="best"),
            "paper": VectorizeOptions(recipe="paper", layers=False),
            "diffvg": VectorizeOptions(recipe="diffvg", layers=False),
            "best, 350 paths": VectorizeOptions(recipe="best", paths=350),
            "best, draft": VectorizeOptions(recipe="best", preset="draft"),
        },
    ),
    "small": (
        "Recipes at 125 paths × 8 cubics, 256 px: as many pixels a path, a fifth of the time",
        {
            "best": VectorizeOptions(paths=125, working_size=256),
            "best, 88 paths": VectorizeOptions(paths=88, working_size=256),
            "best, no layers": VectorizeOptions(paths=125, working_size=256, layers=False),
            "paper": VectorizeOptions(recipe="paper", paths=125, working_size=256, layers=False),
            "diffvg": VectorizeOptions(recipe="diffvg", paths=125, working_size=256, layers=False),
        },
    ),
    "layers": (
        "Three layers and one",
        {"best": VectorizeOptions(), "best, no layers": VectorizeOptions(layers=False)},
    ),
    "fills": (
        "Fills and opacity",
        {
            "gradient, free": VectorizeOptions(),
            "solid, free": VectorizeOptions(fills="solid"),
            "gradient, opaque": VectorizeOptions(opacity="opaque"),
            "solid, opaque": VectorizeOptions(fills="solid", opacity="opaque"),
        },
    ),
    "paths": (
        "Number of paths",
        {f"best, {n}": VectorizeOptions(paths=n) for n in (100, 250, 500, 750, 1000)},
    ),
    "levels": (
        "Number of smoothing levels",
        {f"paper, {n} levels": VectorizeOptions(recipe="paper", levels=n) for n in (1, 2, 3, 4, 5)},
    ),
    "seeds": (
        "Three seeds",
        {
            f"{recipe}, seed {seed}": VectorizeOptions(recipe=recipe, layers=recipe == "best", seed=seed)
            for recipe in ("best", "paper")
            for seed in (0, 1, 2)
        },
    ),
    "scaling": (
        "Time against paths and pixels",
        {
            **{
                f"{n} paths": VectorizeOptions(paths=n, iterations=20, final_iterations=60)
                for n in (100, 500, 1000, 4000)
            },
            **{
                f"{side} px": VectorizeOptions(working_size=side, iterations=20, final_iterations=60)
                for side in (256, 512, 1024, 2048)
            },
        },
    ),
}
POSED = {"rig": posed_table, "unsplit": unsplit_table}  # portraits as drafts, posed; these tables have no ways


def main(arguments: list[str] | None = None) -> int:
    """Run the chosen tables; returns the exit code."""
    options = _parser().parse_args(arguments)
    files = portrait_files(options.portraits or portrait_folder(), options.quick, options.only)
    if not files:
        print(f"No portraits in {options.portraits or portrait_folder()}.", file=sys.stderr)
        return 2
    if unknown := _unknown(options.tables, options.ways):
        print(f"No such table or way: {'; '.join(unknown)}.", file=sys.stderr)
        return 2
    people, lpips = list(sitters(files)), load_lpips()
    options.out.mkdir(parents=True, exist_ok=True)
    report = [_conditions(people, lpips)]
    print(report[0])
    for name in options.tables.split(","):
        if name in POSED:
            report.append(POSED[name](people, "draft", options.out / "rig"))
            print(report[-1], flush=True)
            continue
        title, ways = TABLES[name]
        chosen = [way for way in _ways(name) if options.ways is None or way in options.ways.split(";")]
        lines = [[_run(sitter, way, ways, lpips, options.out / name) for way in chosen] for sitter in people]
        rows = [run.row for line in lines for run in line]
        report.append(means(title, rows))
        print(report[-1], flush=True)
        report.append(side_by_side(f"{title}: PSNR of every portrait", rows))
        contact_sheet(lines).save(options.out / f"{name}.png")
    (options.out / "report.md").write_text("\n".join(report), encoding="utf-8")
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="vectortalker bench", description="Print the benchmark tables.")
    parser.add_argument(
        "--tables", default="recipes", help=f"comma-separated: {', '.join((*TABLES, *POSED))} (default: recipes)"
    )
    parser.add_argument("--ways", metavar="NAMES", help="semicolon-separated lines of the tables, all if absent")
    parser.add_argument("--quick", action="store_true", help="six portraits instead of all")
    parser.add_argument("--only", metavar="NAMES", help="portraits whose file names contain one of these")
    parser.add_argument("--portraits", type=Path, metavar="DIR", help="another folder of pictures")
    parser.add_argument(
        "--out", type=Path, default=Path("bench-out"), metavar="DIR", help="where the results go; those there are kept"
    )
    return parser


def _ways(table: str) -> list[str]:
    """Lines of a table; tracers stand beside the recipes."""
    return [*TABLES[table][1], *(available() if table == "recipes" else ())]


def _unknown(tables: str, ways: str | None) -> list[str]:
    names = tables.split(",")
    known = {way for name in names if name in TABLES for way in _ways(name)}
    return [name for name in names if name not in (*TABLES, *POSED)] + [
        way for way in (ways or "").split(";") if way not in known | {""}
    ]


def _run(sitter: Sitter, way: str, ways: dict[str, VectorizeOptions], lpips: Lpips | None, folder: Path) -> Run:
    """Measure, unless the folder has it from an earlier call."""
    run = kept(folder, sitter.portrait.name, way)
    if run is None:
        run = run_recipe(way, sitter, ways[way], lpips) if way in ways else run_tracer(way, sitter, 512, lpips)
        keep(folder, run)
    row = run.row
    print(
        f"{row.portrait}  {row.way}  {row.metrics.psnr:.2f} dB  {row.metrics.seconds:.1f} s",
        file=sys.stderr,
        flush=True,
    )
    return run


def _conditions(people: list[Sitter], lpips: Lpips | None) -> str:
    names = ", ".join(sitter.portrait.name for sitter in people)
    distance = "LPIPS v0.1, AlexNet" if lpips else "LPIPS not measured (its weights are absent)"
    absent = "".join(f"; {name} not measured (the program is absent)" for name in TRACERS if name not in available())
    python = f"Python {platform.python_version()}, {platform.machine()}"
    return f"{len(people)} portraits ({names}); {distance}{absent}; {python}.\n"


if __name__ == "__main__":
    sys.exit(main())
