"""What every estimator is given and gives back: request, track, bias and interval.

Knows signals and harmonic models; knows no estimator.
"""
