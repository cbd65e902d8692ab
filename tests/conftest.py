"""Fixtures, and how hypothesis runs: the same examples every time, without a deadline."""

import pytest
from hypothesis import settings

from tests.cases import reference

settings.register_profile("timelaw", deadline=None, derandomize=True, max_examples=50)
settings.load_profile("timelaw")


@pytest.fixture(scope="session")
def paper():
    return reference("paper-24-cell")
