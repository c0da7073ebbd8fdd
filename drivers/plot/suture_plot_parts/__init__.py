"""Parts of suture_plot: reads a run, plots it, writes its report."""
