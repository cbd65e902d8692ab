"""The browser of these tests: one for each process. Without it they are skipped, or fail where it is required."""

import pytest

from tests.browser.chromium import Chromium, find_chromium
from tests.tools import miss

MISSING = "Chromium is not installed (apt-get install chromium), or name one in TIMELAW_CHROMIUM"


@pytest.fixture(scope="session")
def browser():
    program = find_chromium()
    if program is None:
        miss(MISSING)
    found = Chromium(program)
    yield found
    found.close()
