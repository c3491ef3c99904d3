"""Records with known truth, over which intervals are counted."""
