"""How a figure is drawn: canvas, theme, labels, SVG that follows the page's colours.

Knows matplotlib; knows no oscillator.
"""
