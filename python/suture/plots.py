"""Plots of a result by the modules of suture_plot."""
import contextlib
import io
import os
import shutil
import sys
import tempfile
import weakref

from . import _suture
from .places import module_of_program


@contextlib.contextmanager
def _drawing():
    """Figures are drawn by Agg, without a display, whatever backend the user's program has chosen."""
    import matplotlib
    from matplotlib import pyplot
    from matplotlib.backends import backend_agg
    use, make = matplotlib.use, pyplot.new_figure_manager
    matplotlib.use = lambda *arguments, **options: None
    pyplot.new_figure_manager = lambda *arguments, **options: backend_agg.new_figure_manager(*arguments, **options)
    try:
        with matplotlib.rc_context(_settings):
            yield
    finally:
        matplotlib.use, pyplot.new_figure_manager = use, make


_settings = {}  # of matplotlib, for plots


def _module(name):
    """A module of suture_plot_parts; its settings of matplotlib are kept apart from those of the user's program. Within _drawing()."""
    module = module_of_program("suture_plot_parts." + name)
    if not _settings:
        import matplotlib
        _settings.update({key: matplotlib.rcParams[key] for key in matplotlib.rcParams if not key.startswith("backend")})
    return module


def _png(figure):
    image = io.BytesIO()
    figure.savefig(image, format="png", dpi=120, bbox_inches="tight", pad_inches=0.08)
    return image.getvalue()


def _in_notebook():
    shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    return getattr(shell, "kernel", None) is not None


def _display(figure):
    """In a notebook the picture, otherwise a window. RuntimeError: there is no display."""
    if _in_notebook():
        from IPython.display import Image, display
        display(Image(_png(figure)))
        return
    from matplotlib import pyplot
    if sys.platform.startswith("linux") and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        raise RuntimeError("show=True: there is no display; pass file=\"plot.png\" instead")
    image = pyplot.imread(io.BytesIO(_png(figure)))
    window = pyplot.figure(figsize=(image.shape[1] / 120, image.shape[0] / 120), dpi=120)
    window.figimage(image)
    pyplot.show()


class Plots:
    """The plots of a result. Draws from the files of its run, which are written into a temporary folder unless they exist."""

    def __init__(self, result, output):
        self._result, self._output, self._temporary = result, output, None

    def plot(self, kind, file, show, factor, zoom, view, cut):
        """See Result.plot(). Collective."""
        result = self._result
        folder = self._folder()

        def draw():
            return self._draw(folder, kind, file, show, factor, zoom, view, cut) if result.comm.rank == 0 else None
        return _suture.together(result.comm, draw)

    def _folder(self):
        """Folder with the files of the run. Collective."""
        comm = self._result.comm
        known = comm.bcast(self._is_output() if comm.rank == 0 else None, root=0)
        if known:
            return self._output
        if self._temporary is None:
            made = comm.bcast(_suture.together(comm, lambda: tempfile.mkdtemp(prefix="suture_") if comm.rank == 0 else None), root=0)
            if comm.rank == 0:
                weakref.finalize(self, shutil.rmtree, made, ignore_errors=True)
            self._result.write(made)
            self._temporary = made
        return self._temporary

    def _is_output(self):
        """The output folder still has the results of this run."""
        import json
        try:
            with open(os.path.join(self._output, "summary.json"), encoding="utf-8") as file:
                return json.load(file) == self._result.summary
        except (TypeError, OSError, ValueError):
            return False

    def _draw(self, folder, kind, file, show, factor, zoom, view, cut):
        try:
            with _drawing():
                drawn = self._drawn(folder, kind, factor, zoom, view, cut)
        except ImportError as error:
            if (error.name or "").split(".")[0] in ("h5py", "matplotlib"):
                raise ImportError("%s. On Debian: apt-get install python3-h5py python3-matplotlib" % error) from error
            raise
        figure = drawn.figure
        figure.caption = drawn.caption
        figure._repr_png_ = lambda: _png(figure)
        if file is not None:
            figure.savefig(os.fspath(file), dpi=170, bbox_inches="tight", pad_inches=0.08)
        if show:
            _display(figure)
        return figure

    @staticmethod
    def _drawn(folder, kind, factor, zoom, view, cut):
        """The picture, with its figure removed from pyplot."""
        pictures, run_folder, style = _module("pictures"), _module("run"), _module("style")
        from matplotlib import pyplot
        names = []
        try:
            for picture in pictures.pictures(run_folder.RunFolder(folder), factor, zoom, view, cut):
                names.append(picture.name)
                pyplot.close(picture.figure)
                if picture.name == kind:
                    return picture
        except style.PlotError as error:
            raise ValueError(str(error)) from error
        raise ValueError("kind: this run has no plot '%s'; it has %s" % (kind, ", ".join(names) or "none: it wrote no fields"))
