"""Hostile input: whatever bytes a reader is given, it returns or says what is wrong; `python -m tests.fuzz --help`.

The corpus holds small files of every kind. `mutations` spoils them, `readers` reads them as the commands do
and judges what comes of it; anything but a result or a fault with a message is a failure.
"""
