"""Generated numeric code: one coefficient form, one file per target language."""
