"""Trains a network step by step, keeping a moving average of its weights; goes on where an earlier run was cut."""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
import torch
from torch import Tensor, nn
from torch.optim.swa_utils import AveragedModel, get_ema_multi_avg_fn

BATCH = 32  # pieces of clips
PEAK_RATE = 3e-3
AVERAGE_DECAY = 0.998  # a step: the weights kept are the mean of those of a last epoch or two


@dataclass(frozen=True)
class Plan:
    width: int
    seed: int
    n_epochs: int
    peak_rate: float


def parser_of(description: str, width: int, n_epochs: int) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("corpus", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--width", type=int, default=width)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--epochs", type=int, default=n_epochs)
    parser.add_argument("--rate", type=float, default=PEAK_RATE, help="peak learning rate (default: %(default)s)")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--start", type=Path, help="weights of an earlier run, of the same width, to go on from")
    return parser


def train(
    options: argparse.Namespace,
    kind: Callable[[int], nn.Module],
    loss_of: Callable[[nn.Module, np.random.Generator], Tensor],
    n_steps: int,
    hours: dict[str, float],
) -> None:
    """Train a network of a `kind` as `options` of `parser_of` say, `n_steps` batches an epoch; tell how beside it."""
    plan = Plan(options.width, options.seed, options.epochs, options.rate)
    torch.set_num_threads(options.threads)
    torch.manual_seed(plan.seed)
    network = kind(plan.width)
    if options.start:
        network.load_state_dict(torch.load(options.start, weights_only=True))
    _train(network, loss_of, n_steps, plan, options.out)
    made = {"runs": [*_runs_before(options.start), asdict(plan)], "hours": hours}
    options.out.with_suffix(".json").write_text(json.dumps(made, indent=2) + "\n", encoding="utf-8")


def _runs_before(start: Path | None) -> list[dict]:
    """Plans of the runs that made the weights of `start`, as the file beside them tells."""
    return json.loads(start.with_suffix(".json").read_text(encoding="utf-8"))["runs"] if start else []


def _train(network: nn.Module, loss_of: Callable, n_steps: int, plan: Plan, out: Path) -> None:
    """Write the averaged weights to `out` after each epoch; go on where an earlier run of the same plan was cut."""
    generator = np.random.default_rng(plan.seed)
    average = AveragedModel(network, multi_avg_fn=get_ema_multi_avg_fn(AVERAGE_DECAY), use_buffers=True)
    optimiser = torch.optim.AdamW(network.parameters(), plan.peak_rate, weight_decay=1e-2)
    schedule = torch.optim.lr_scheduler.OneCycleLR(
        optimiser, plan.peak_rate, total_steps=plan.n_epochs * n_steps, pct_start=0.1
    )
    parts = (network, average, optimiser, schedule)
    state = out.with_suffix(".state")
    first = _resumed(state, plan, parts, generator) if state.exists() else 0
    for epoch in range(first, plan.n_epochs):
        losses = [_step(network, loss_of, parts[1:], generator) for _ in range(n_steps)]
        kept = [part.state_dict() for part in parts]
        torch.save((plan, epoch + 1, kept, generator.bit_generator.state, torch.get_rng_state()), state)
        torch.save(average.module.state_dict(), out)
        told = f"epoch {epoch + 1}/{plan.n_epochs}: loss {np.mean(losses):.4f}, {time.process_time():.0f} CPU s"
        print(told, flush=True)


def _step(network: nn.Module, loss_of: Callable, parts: tuple, generator: np.random.Generator) -> float:
    average, optimiser, schedule = parts
    loss = loss_of(network, generator)
    optimiser.zero_grad()
    loss.backward()
    torch.nn.utils.clip_grad_norm_(network.parameters(), 1.0)
    optimiser.step()
    schedule.step()
    average.update_parameters(network)
    return loss.item()


def _resumed(state: Path, plan: Plan, parts: tuple, generator: np.random.Generator) -> int:
    """Put the kept state into the parts and the generators; the number of epochs done. Another plan's is refused."""
    kept_plan, n_done, kept, numbers, torch_numbers = torch.load(state, weights_only=False)
    if kept_plan != plan:
        raise SystemExit(f"{state} is of another run, {kept_plan}: remove it, or give its options.")
    for part, values in zip(parts, kept, strict=True):
        part.load_state_dict(values)
    generator.bit_generator.state = numbers
    torch.set_rng_state(torch_numbers)
    return n_done
