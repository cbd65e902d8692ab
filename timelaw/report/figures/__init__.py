"""Pictures as SVG texts. Matplotlib is imported only when one is drawn."""
