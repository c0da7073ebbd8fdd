"""Pictures of runs in space. Nothing here needs a display or a graphics library: NumPy draws the images, matplotlib the pages."""
