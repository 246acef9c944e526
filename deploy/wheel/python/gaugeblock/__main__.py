"""`python -m gaugeblock` runs the command that the wheel has brought."""
import os
import shutil
import sys
import sysconfig


def command():
    """The path of the command: in the scripts of this Python, or of the user, or on the search path."""
    folders = [sysconfig.get_path("scripts"), sysconfig.get_path("scripts", scheme=f"{os.name}_user")]
    for folder in folders:
        path = os.path.join(folder, "gaugeblock")
        if os.access(path, os.X_OK):
            return path
    return shutil.which("gaugeblock")


if __name__ == "__main__":
    path = command()
    if path is None:
        sys.exit("error: the command gaugeblock is not installed; hint: pip install --force-reinstall gaugeblock")
    os.execv(path, [path, *sys.argv[1:]])
