"""What every room may use: the one error, the form of progress, and files that are written whole.

Nothing here knows an oscillator or a signal, and nothing here imports more than the standard library.
"""
