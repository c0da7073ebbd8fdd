"""Standard output of the programs: what cannot be printed is an error, once."""
import os
import sys


def checked(program, main):
    """Exit code of a program: that of main(), or 5 where its text could not be written."""
    try:
        code = main()
        if sys.stdout is not None:  # None: closed by the caller, who wants no text
            sys.stdout.flush()
    except OSError as error:  # main() knows those of files
        print(f"{program}: standard output cannot be written: {error.strerror}", file=sys.stderr)
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # Python tries again at its end
        return 5
    return code
