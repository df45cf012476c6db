# SPDX-License-Identifier: BSD-3-Clause
"""The colour cue."""

from typing import Optional

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from .errors import UsageError
from .inputs import per_detection
from .options import Options, settings


def colour_vectors(
    image: np.ndarray, boxes: ArrayLike, options: Optional[Options] = None
) -> np.ndarray:
    """Colours [N, D] for Mapper.add_frame from the pixels of each box.

    Args:
        image: uint8 [H, W, 3] in the order blue, green, red, as OpenCV reads it.
        boxes: [N, 4] left, top, right, bottom [px]; a box without pixels has a row of zeros.
        options: nested dict with the keys of a run; those of `colour` count.
    """
    if not isinstance(image, np.ndarray) or image.dtype != np.uint8:
        raise UsageError(f"image is {type(image).__name__}, expected a NumPy array of uint8")
    if image.ndim != 3 or image.shape[2] != 3 or 0 in image.shape:
        raise UsageError(f"image has the shape {image.shape}, expected (H, W, 3)")
    sides = per_detection("boxes", boxes, len(np.atleast_1d(boxes)), (4,))
    return _core.colour_vectors(np.ascontiguousarray(image), sides, settings(options))
