"""Parts of suture_plot: reading a run, drawing its pictures, writing its report."""
