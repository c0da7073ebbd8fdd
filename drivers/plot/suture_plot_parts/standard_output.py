"""Standard output of the programs: a failed write is an error, reported once."""
import os
import sys


def checked(program, main):
    """Exit code of a program: that of main(), or 5 if its text could not be written."""
    try:
        code = main()
        if sys.stdout is not None:  # None: the caller has closed it and wants no text
            sys.stdout.flush()
    except OSError as error:  # main() handles those of files
        print(f"{program}: standard output cannot be written: {error.strerror}", file=sys.stderr)
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # otherwise Python flushes again at its end
        return 5
    return code
