"""
A reassigned spectrogram
========================

Each value is moved to where its energy is.
"""

import ridgeback

sample = ridgeback.sample("decay")
axes = ridgeback.reassigned_spectrogram(sample.recording.values, 40.0, window_seconds=4.0).plot()
axes.set_ylim(0, 30)
