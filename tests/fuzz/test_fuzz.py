"""A few inputs for every target; `npm run soak` tries many thousands."""

from __future__ import annotations

import pytest
from hypothesis import HealthCheck, given, settings

from .targets import TARGETS

EXAMPLES = 40  # of each target: some two seconds in all


@pytest.mark.parametrize("name", TARGETS)
def test_input_from_outside_is_read_or_refused(name: str) -> None:
    target = TARGETS[name]

    @settings(
        max_examples=EXAMPLES, deadline=None, database=None, derandomize=True, suppress_health_check=list(HealthCheck)
    )
    @given(target.inputs)
    def property_holds(given_input: object) -> None:
        target.run(given_input)

    property_holds()
