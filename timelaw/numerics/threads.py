"""Linear algebra on one thread: sums made in another order have other last digits."""

from contextlib import AbstractContextManager
from typing import cast


def on_one_thread() -> AbstractContextManager[None]:
    """While it lasts, NumPy's and SciPy's BLAS use one thread, however many there are."""
    from threadpoolctl import threadpool_limits

    return cast(AbstractContextManager[None], threadpool_limits(limits=1))
