#!/usr/bin/env python3
"""What a command costs: cost.py COMMAND… runs it with its output thrown away and prints the seconds of processor time
that it took, in user and in system mode together, and the most kilobytes that it held. Its status is that of the command.
"""
import resource
import subprocess
import sys

# What was run to start this program counts as its children, too.
before = resource.getrusage(resource.RUSAGE_CHILDREN)
done = subprocess.run(sys.argv[1:], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
if done.returncode != 0:
    sys.exit(done.stderr[:400] or f"status {done.returncode}")
print(used.ru_utime + used.ru_stime - before.ru_utime - before.ru_stime, used.ru_maxrss)
