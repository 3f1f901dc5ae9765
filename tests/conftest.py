"""How the tests run: Hypothesis draws the same robots on every CI run, and fresh ones at home."""

from __future__ import annotations

import os

from hypothesis import HealthCheck, settings

settings.register_profile(
    "home",
    deadline=None,
    max_examples=60,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
)
settings.register_profile("ci", parent=settings.get_profile("home"), derandomize=True, print_blob=True)
settings.load_profile("ci" if os.environ.get("CI") else "home")
