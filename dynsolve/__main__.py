"""`python -m dynsolve`."""

from __future__ import annotations

from dynsolve.cli.main import main

if __name__ == "__main__":
    main()
