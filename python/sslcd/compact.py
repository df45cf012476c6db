# SPDX-License-Identifier: BSD-3-Clause
"""The base of the dataclasses with large arrays."""

from dataclasses import fields

import numpy as np


class _Compact:
    """repr() with the shapes of large arrays instead of their numbers."""

    def __repr__(self) -> str:
        shown = []
        for each in fields(self):  # type: ignore[arg-type]
            value = getattr(self, each.name)
            large = (isinstance(value, np.ndarray) and value.size > 4) or (
                isinstance(value, list) and value
            )
            shown.append(
                f"{each.name}=<{np.shape(value) if not isinstance(value, list) else len(value)}>"
                if large
                else f"{each.name}={value!r}"
            )
        return f"{type(self).__name__}({', '.join(shown)})"
