# SPDX-License-Identifier: BSD-3-Clause
"""Connected components."""

from typing import Dict, Iterable, List


class Components:
    """Which items are connected, by the pairs told so far (union-find)."""

    def __init__(self, items: Iterable[str]) -> None:
        self._parent: Dict[str, str] = {item: item for item in items}

    def _root(self, item: str) -> str:
        root = item
        while self._parent[root] != root:
            root = self._parent[root]
        while self._parent[item] != root:
            self._parent[item], item = root, self._parent[item]
        return root

    def connected(self, a: str, b: str) -> bool:
        """Whether a path of pairs leads from a to b."""
        return self._root(a) == self._root(b)

    def connect(self, a: str, b: str) -> None:
        """Tells that a and b belong together."""
        self._parent[self._root(b)] = self._root(a)

    def groups(self) -> List[List[str]]:
        """All components, in the order of their first items."""
        groups: Dict[str, List[str]] = {}
        for item in self._parent:
            groups.setdefault(self._root(item), []).append(item)
        return list(groups.values())
