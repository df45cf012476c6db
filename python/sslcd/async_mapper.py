# SPDX-License-Identifier: BSD-3-Clause
"""A mapper on a thread of its own."""

import atexit
import weakref
from typing import Any, Mapping, Optional

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from .frame_taker import FrameTaker
from .inputs import Camera, array
from .layouts import PlaceMatcher
from .mapper import KITTI_UP, Mapper, _wrap, context
from .options import Options, settings
from .results import AsyncReport

# A thread that is in a place matcher must not outlive the interpreter.
_running: "weakref.WeakSet[AsyncMapper]" = weakref.WeakSet()


@atexit.register
def _close_all() -> None:
    for mapper in list(_running):
        mapper.close()


class AsyncMapper(FrameTaker[bool]):
    """A Mapper on a thread of its own, for hosts that must not wait. Calls return at once but for
    wait() and snapshot(). All are thread-safe. `with AsyncMapper(...) as mapper:` closes it at the
    end.

    The arguments are those of Mapper; an exception of `place_matcher` ends the thread, and the
    report says so (`failure`). At most `most_waiting` frames wait. A frame that finds the queue full,
    or the thread failed, is dropped and counted: add_frame returns False, and the step to the next
    frame then spans it. What Mapper.add_frame raises for the values of a frame is counted in the
    report.

    A copy is refined on a second thread, while frames go on, and then gets the frames since. That
    begins by itself when a loop was accepted and the path has become longer by `refine_every_m`
    [m], and by a twentieth, since the last one began; 0: only by refine(). The result, but for
    ids, depends on the frames alone, unless some are dropped.
    """

    def __init__(
        self,
        options: Optional[Options] = None,
        *,
        labels: Optional[Mapping[str, str]] = None,
        up: ArrayLike = KITTI_UP,
        camera: Optional[Camera] = None,
        place_matcher: Optional[PlaceMatcher] = None,
        most_waiting: int = 64,
        refine_every_m: float = 50.0,
    ) -> None:
        given = context(labels, up, camera, place_matcher)
        most = int(array("most_waiting", most_waiting, (), np.int32))
        every_m = float(array("refine_every_m", refine_every_m, (), float))
        super().__init__(_core.AsyncMapper(settings(options), given, most, every_m))
        _running.add(self)

    def refine(self, at_end: bool = True) -> None:
        """Mapper.refine after the frames handed in so far, on a second thread."""
        self._core.refine(bool(at_end))

    def snapshot(self) -> Mapper:
        """Waits for all that was handed in so far and returns a copy of the mapper. Raises
        NoSolutionError if the thread has failed."""
        return _wrap(self._core.snapshot(), self._next_index)

    def take_report(self) -> AsyncReport:
        """What was done since the last call."""
        return self._core.take_report()

    def wait(self) -> None:
        """Waits until all that was handed in is done. ctrl-C interrupts it."""
        self._core.wait()

    def close(self) -> None:
        """Ends the thread after the frame in work; what waits is not done. Other calls then raise
        UsageError."""
        self._core.close()

    @property
    def closed(self) -> bool:
        return self._core.closed()

    def __enter__(self) -> "AsyncMapper":
        return self

    def __exit__(self, *exception: Any) -> None:
        self.close()
