# SPDX-License-Identifier: BSD-3-Clause
"""Which pairs of drives are worth to be compared."""

from itertools import combinations
from typing import List, Sequence, Tuple

from .tasks import Record

#: Names of the drive that is localised, and of that whose map it is looked for in.
Pair = Tuple[str, str]


def all_pairs(maps: Sequence[Record]) -> List[Pair]:
    """Every drive with every other one, once."""
    return [(query["name"], target["name"]) for target, query in combinations(maps, 2)]
