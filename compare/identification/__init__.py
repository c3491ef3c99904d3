"""What made it?  Oscillator classes fitted to one decay, ranked, and used to predict it."""
