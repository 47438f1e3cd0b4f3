"""Requests made from the OpenAPI document: no answer is a fault of ours, and every refusal has its form."""

from __future__ import annotations

import schemathesis
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from vectortalker.schema import ApiError
from vectortalker.server.app import create_app
from vectortalker.server.services import Services

from .conftest import Socket

EXAMPLES = 2  # an operation


def test_requests_of_the_document_are_answered(services: Services, listening: Socket) -> None:
    listening.app = create_app(services)
    document = schemathesis.openapi.from_url(f"{listening.url}/api/openapi.json")
    operations = [found.ok() for found in document.get_all_operations()]
    assert len(operations) > 10
    for operation in operations:
        _try(operation.as_strategy())


def _try(cases: st.SearchStrategy[schemathesis.Case]) -> None:
    @settings(max_examples=EXAMPLES, deadline=None, database=None, suppress_health_check=list(HealthCheck))
    @given(cases)
    def is_answered(case: schemathesis.Case) -> None:
        answer = case.call()
        assert answer.status_code < 500, answer.text
        if answer.status_code >= 400:
            ApiError.model_validate_json(answer.content)

    is_answered()
