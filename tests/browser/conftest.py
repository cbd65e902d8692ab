"""The browser of these tests: one for each process. Without it they are skipped, or fail where it is required."""

import os

import pytest

from tests.browser.chromium import Chromium, find_chromium

REQUIRED = "TIMELAW_BROWSER"  # set to "required", as .ci/run does, a missing browser is a failure
MISSING = "Chromium is not installed (apt-get install chromium), or name one in TIMELAW_CHROMIUM"


@pytest.fixture(scope="session")
def browser():
    program = find_chromium()
    if program is None:
        if os.environ.get(REQUIRED) == "required":
            pytest.fail(MISSING)
        pytest.skip(MISSING)
    found = Chromium(program)
    yield found
    found.close()
