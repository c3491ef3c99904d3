"""How every result shows itself: in a line, as formulas or a short table, as a picture or a page, as a DataFrame.

May import only what stands in ``common``; what draws and what makes pages is named here, and imported when asked for.
"""
