"""A few inputs for every target; `npm run soak` tries many thousands."""

from __future__ import annotations

from random import Random

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from .targets import TARGETS

MAX_SEED = 2**32
EXAMPLES = 40  # of each target: some two seconds in all


@pytest.mark.parametrize("name", TARGETS)
def test_input_from_outside_is_read_or_refused(name: str) -> None:
    target = TARGETS[name]
    drawn = isinstance(target.inputs, st.SearchStrategy)
    inputs = target.inputs if drawn else st.integers(0, MAX_SEED).map(lambda seed: target.inputs(Random(seed)))

    @settings(
        max_examples=EXAMPLES, deadline=None, database=None, derandomize=True, suppress_health_check=list(HealthCheck)
    )
    @given(inputs)
    def property_holds(given_input: object) -> None:
        target.run(given_input)

    property_holds()
