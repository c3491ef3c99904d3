"""What a record holds beside its one smooth oscillation: steady tones and other modes, spikes, clipped samples.

Knows signals and models of them; hands on samples with one oscillation in white noise, and says what was taken off.
"""
