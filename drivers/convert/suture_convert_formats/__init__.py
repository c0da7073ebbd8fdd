"""Readers and writers of suture_convert, one file a format."""
