"""Writes animated GIF files with one table of colours for all frames."""
import os

import numpy as np

BITS = 5  # of each channel, in the table that finds the nearest colour
GREYS = 24
LEVELS = 24  # of the colour map; 40 make the files a quarter larger
LIGHTS = (1.0, 0.92, 0.84, 0.76, 0.5)  # of shaded surfaces and of lines on them


class Colours:
    """A colour map under several lights, and greys: at most 256 colours."""

    def __init__(self, colours, levels=LEVELS, lights=LIGHTS):
        bright = colours(np.linspace(0, 1, levels))[:, :3]
        table = np.vstack([*(light * bright for light in lights), np.repeat(np.linspace(0, 1, GREYS)[:, None], 3, axis=1)])
        self.table = np.round(255 * table).astype(np.uint8)
        steps = np.linspace(0, 255, 2**BITS)
        cells = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)
        table = self.table.astype(float)
        self._nearest = np.argmin((table**2).sum(axis=1) - 2 * cells @ table.T, axis=1).astype(np.uint8)

    def numbers(self, image):
        """Rows x columns numbers of the nearest colours. `image`: bytes of red, green, blue and any other channels"""
        red, green, blue = (image[:, :, k].astype(np.int32) >> 8 - BITS for k in range(3))
        return self._nearest[(red << 2 * BITS) + (green << BITS) + blue]


def write_gif(path, images, durations, colours):
    """Writes the images under a temporary name, and renames the file; the animation is repeated without end. \\return path

    \\param images     iterable of rows x columns x 3 or 4 bytes, all of one size; one at a time is held in full colour
    \\param durations  of the frames, in milliseconds
    """
    from PIL import Image

    table = np.vstack([colours.table, np.zeros((256 - len(colours.table), 3), dtype=np.uint8)]).tobytes()

    def frames():
        for image in images:
            frame = Image.fromarray(colours.numbers(image), "P")
            frame.putpalette(table)
            yield frame

    rest = frames()
    partial = path.with_name(path.name + ".part")
    next(rest).save(partial, "GIF", save_all=True, append_images=rest, duration=[10 * max(round(one / 10), 2) for one in durations], loop=0,
                    optimize=False)
    os.replace(partial, path)
    return path
