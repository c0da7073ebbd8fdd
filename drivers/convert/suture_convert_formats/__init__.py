"""Readers and writers of suture_convert, one file per format."""
