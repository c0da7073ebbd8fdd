"""Plots of 3D runs. No display or graphics library is needed: NumPy renders the images, matplotlib the pages."""
