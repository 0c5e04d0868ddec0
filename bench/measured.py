"""What all benchmarks write: their figures as JSON, in Google Benchmark's form, each case with the day on which it was
measured, the machine, and how busy that was when the case began."""
import datetime
import json
import os
import pathlib


def machine():
    """Cores, processor and memory, in words."""
    model = next((line.split(":")[1].strip() for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines()
                  if line.startswith("model name")), "an unknown processor")
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    return f"{os.cpu_count()} cores of {model}, {memory:.0f} GiB of memory"


def stamp():
    """To be taken before a case is run."""
    return {"day": datetime.date.today().isoformat(), "machine": machine(), "load": round(os.getloadavg()[0], 1)}


def write(path, results, **more):
    """`results`: a list of dictionaries, each with the `name` of its case."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps({**more, "benchmarks": results}, indent=2) + "\n")
