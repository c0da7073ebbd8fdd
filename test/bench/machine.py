"""The machine, and the bandwidth of its memory."""
import datetime
import multiprocessing
import os
import re
import statistics
import time
from pathlib import Path


def machine():
    cpu = re.search(r"model name\s*:\s*(.*)", Path("/proc/cpuinfo").read_text())
    memory = re.search(r"MemTotal:\s*(\d+)", Path("/proc/meminfo").read_text())
    return {"cores": len(os.sched_getaffinity(0)), "cpu": cpu.group(1) if cpu else "unknown", "memory_gib": int(memory.group(1)) / 2**20,
            "date": datetime.date.today().isoformat(), "load_before": os.getloadavg()[0]}


def stream(barrier, queue, entries):
    """GB/s of this process while the others run: STREAM's triad and pure reading, best of nine; and the median of reading."""
    import numpy  # only in the workers: OpenBLAS reads its environment when it is loaded
    b, c, a = numpy.full(entries, 1.0), numpy.full(entries, 2.0), numpy.zeros(entries)
    numpy.dot(b[:1000], c[:1000])
    triads, reads = [], []
    for _ in range(9):
        barrier.wait()
        begin = time.perf_counter()
        numpy.multiply(c, 3.0, out=a)  # one read, one write
        numpy.add(a, b, out=a)         # two reads, one write
        triads.append(5 * 8 * entries / (time.perf_counter() - begin) / 1e9)
        barrier.wait()
        begin = time.perf_counter()
        numpy.dot(b, c)                # two reads
        reads.append(2 * 8 * entries / (time.perf_counter() - begin) / 1e9)
    queue.put({"triad": max(triads), "read": max(reads), "read_median": statistics.median(reads)})


def bandwidth(processes, entries=20_000_000):
    """GB/s of the given number of simultaneous processes."""
    os.environ["OPENBLAS_NUM_THREADS"] = "1"  # for the workers
    context = multiprocessing.get_context("spawn")
    barrier, queue = context.Barrier(processes), context.Queue()
    workers = [context.Process(target=stream, args=(barrier, queue, entries)) for _ in range(processes)]
    for worker in workers:
        worker.start()
    results = [queue.get(timeout=300) for _ in workers]
    for worker in workers:
        worker.join()
    return {key: sum(result[key] for result in results) for key in results[0]}
