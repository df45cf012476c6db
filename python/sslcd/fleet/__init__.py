# SPDX-License-Identifier: BSD-3-Clause
"""Maps of many drives, on Dask: `pip install 'sslcd[fleet]'`, docs/fleets.md.

`python -m sslcd.fleet build DRIVES... --out SITES` is the same as build_fleet().
"""

try:
    import distributed  # noqa: F401
    import fsspec  # noqa: F401
except ImportError as problem:
    raise ImportError(
        f"sslcd.fleet needs Dask distributed: pip install 'sslcd[fleet]', or on Debian and Ubuntu "
        f"apt install python3-distributed python3-fsspec ({problem})"
    ) from problem

from .build import build_fleet
from .drives import Drive, find_drives
from .report import FleetReport
from .settings import FleetSettings

__all__ = ["Drive", "FleetReport", "FleetSettings", "build_fleet", "find_drives"]
