#!/usr/bin/env python3
"""The cost of a command: cost.py COMMAND… runs the command without its output, and prints the seconds of processor time in
user and system mode together, and its peak memory in kilobytes. It fails if the command fails.
"""
import resource
import subprocess
import sys

# Processes that ran before, to start this program, count as its children too; their time is subtracted.
before = resource.getrusage(resource.RUSAGE_CHILDREN)
done = subprocess.run(sys.argv[1:], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
if done.returncode != 0:
    sys.exit(done.stderr[:400] or f"status {done.returncode}")
print(used.ru_utime + used.ru_stime - before.ru_utime - before.ru_stime, used.ru_maxrss)
