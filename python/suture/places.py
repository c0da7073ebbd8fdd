"""Where the modules of the programs are: suture_plot_parts and suture_convert_formats."""
import importlib
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
# In a build folder python/suture is beside drivers; in an installation the modules are in share/suture of the same prefix.
FOLDERS = [HERE.parent.parent / "drivers", *(parent / "share" / "suture" for parent in HERE.parents)]


def module_of_program(name):
    """A module that a program uses, such as "suture_plot_parts.pictures"."""
    package = name.split(".", maxsplit=1)[0]
    for folder in FOLDERS:
        if (folder / package / "__init__.py").is_file():
            if str(folder) not in sys.path:
                sys.path.append(str(folder))
            return importlib.import_module(name)
    raise ModuleNotFoundError("the package %s is in none of the folders %s: Suture is not completely installed"
                              % (package, ", ".join(map(str, FOLDERS))), name=package)
