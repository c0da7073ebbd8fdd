"""Numbers packed for a page: 16 bits per value, base64."""
import base64

import numpy as np

MOST = 65534  # largest code of a value
MISSING = 65535  # code of NaN


def text(array):
    return base64.b64encode(np.ascontiguousarray(array).tobytes()).decode()


def size(count):
    """Characters of the text of `count` bytes."""
    return 4 * ((count + 2) // 3)


def integers(array):
    """Whole numbers from 0 on, with 16 bits each if they suffice, else 32."""
    wide = array.max(initial=0) >= MISSING
    return {"bits": 32 if wide else 16, "data": text(array.astype("<u4" if wide else "<u2"))}


class Scale:
    """Codes for the values between `low` and `high`; arrays: one range per column."""

    def __init__(self, low, high):
        self.low = np.asarray(low, dtype=float)
        span = np.asarray(high, dtype=float) - self.low
        self.step = np.where(span > 0, span, 1.0) / MOST

    def codes(self, values):
        known = np.isfinite(values)
        found = np.rint((np.where(known, values, self.low) - self.low) / self.step)
        return np.where(known, np.clip(found, 0, MOST), MISSING).astype("<u2")

    def words(self):
        return {"low": self.low.tolist(), "step": self.step.tolist()}


def scale_of(arrays):
    """The common scale of arrays with values in columns, or without columns. NaN and infinity do not count."""
    whole = [np.where(np.isfinite(array), array, np.nan) for array in arrays if len(array)]
    known = [array for array in whole if np.isfinite(array).any()]
    if not known:
        columns = arrays[0].shape[1:] if len(arrays) else ()
        return Scale(np.zeros(columns), np.zeros(columns))
    return Scale(np.min([np.nanmin(array, axis=0) for array in known], axis=0), np.max([np.nanmax(array, axis=0) for array in known], axis=0))
