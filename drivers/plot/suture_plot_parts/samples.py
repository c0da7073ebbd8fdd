"""An image of samples on axes."""
import numpy as np
from matplotlib.artist import Artist


class Samples(Artist):
    """Image with one sample per pixel of the saved picture, drawn as it is: matplotlib would interpolate it.

    Covers the whole axes. `image`: rows x columns x 4 bytes, the lowest row first. At another resolution, the nearest samples are drawn.
    """

    def __init__(self, image):
        super().__init__()
        self.image = image
        self.set_zorder(1)

    def draw(self, renderer):
        if not self.get_visible() or not self.image.size:
            return
        box = self.axes.bbox
        columns, rows = max(round(box.width), 1), max(round(box.height), 1)
        image = self.image
        if image.shape[:2] != (rows, columns):
            row, column = ((np.arange(wanted) * have) // wanted for wanted, have in zip((rows, columns), image.shape))
            image = image[row[:, None], column]
        context = renderer.new_gc()
        renderer.draw_image(context, round(box.x0), round(box.y0), image[::-1] if UPSIDE_DOWN else image)
        context.restore()


UPSIDE_DOWN = False


def show(axes, image):
    """Shows an image that covers the axes."""
    axes.add_artist(Samples(image))
