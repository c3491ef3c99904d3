"""Exact expansions of oscillators: equations in, frequencies as rational series out."""
