"""Observes LinuxCNC's interpreter from within a program; rs274.py, next to this folder, uses it.

The stand-alone rs274 prints canonical calls and error messages, but neither blocks nor modes. The program therefore
runs with checkpoint lines after each of its lines, which print the place and the values of parameters. The output
between two checkpoints belongs to the block between them.

Read them in this order:

    text      the little that must be known of a program's text
    plan      the program with its checkpoints
    machine   the files of the machine, and rs274 as a process
    session   the runs that one outcome takes
    printed   what was printed: calls, checkpoints, text
    waiting   calls that wait under cutter compensation, back in program order
    settings  active settings; lengths, in the active unit
    state     a checkpoint in the fields of the vocabulary
    canon     calls as settings and effects
    steps     executed blocks, made of one checkpoint after the other
    faults    error messages: which block was refused, and why
    outcome   all of it put together
    support   what can be run, and what is shown of it
"""
