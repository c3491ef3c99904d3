"""Other packages on the same tasks; they are used here only, and are no dependency."""
