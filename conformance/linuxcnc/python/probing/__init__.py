"""Observing LinuxCNC's interpreter from within a program: what rs274.py, beside this folder, stands on.

The stand-alone rs274 prints canonical calls, and what an error is, but neither blocks nor modes. So a program is run with probe lines after each of
its lines, which print where it is and what parameters show there: what is done between two probes, the block between them did.

Read them in this order:

    text      the little that must be known of a program's text
    plan      the program with its probes
    machine   the files of the machine, and rs274 as a process
    session   the runs that one outcome takes
    printed   what was printed: calls, probes, text
    settings  what is in force; lengths, in the unit that is active
    state     a probe in the fields of the vocabulary
    canon     calls as settings and effects
    steps     executed blocks, made of one probe after the other
    faults    error messages: which block was refused, and why
    outcome   all of it put together
    support   what can be run, and what is shown of it
"""
