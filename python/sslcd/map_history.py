# SPDX-License-Identifier: BSD-3-Clause
"""What has changed from session to session of a map (docs/change.md)."""

from typing import Any, List, Mapping

from .map_results import ChangeRates, PlaceHistory, PlaceOutcome


class MapHistory:
    """What was there when, in each session of a map: Map.history."""

    def __init__(self, core: Any) -> None:
        self._core = core

    @property
    def places(self) -> List[PlaceHistory]:
        """All places where an object has stood in some session."""
        return self._core.places()

    @property
    def rates(self) -> Mapping[str, ChangeRates]:
        """How often places change from one session to the next, by label; learnt."""
        return self._core.rates()

    def between(self, place: int, before: int, after: int) -> PlaceOutcome:
        """What became of places[place] between two sessions, by their indices in Map.sessions, the
        earlier one first. Raises UsageError for other numbers."""
        return self._core.between(place, before, after)
