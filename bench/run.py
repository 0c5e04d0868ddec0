#!/usr/bin/env python3
"""Runs benchmarks, each in a process of its own, so that peak memory is that of the case alone.

Usage: bench/run.py PROGRAM [--out FILE.json] [--filter REGEX] [--scene FILE]
PROGRAM is penumbra_bench of a release build. Without a filter all cases run, for some half an hour;
`scripts/performance_tables --cases` prints a filter for those of docs/performance.md. With --scene,
direct light of that scene is a case, too: direct/own/default. Results go to FILE.json in Google
Benchmark's format, all of them as tables to standard output."""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import measured

DIRECT = ["elements", "lamps", "mesh_s", "direct_s", "direct_cpu_s", "rays", "Mrays_per_s",
          "direct_over_bare", "direct_over_bare_cpu", "direct_over_bare_embree",
          "direct_over_bare_embree_cpu", "outside_embree_share", "entries", "bytes_per_entry",
          "cpu_ns_per_element_lamp", "row_bytes_per_element_lamp", "peak_bytes_per_element_lamp",
          "peak_MB"]
INDIRECT = ["patches", "elements", "nodes", "shots", "certificate", "mean_radiosity", "indirect_s",
            "rays", "Mrays_per_s", "entries", "bytes_per_entry", "rows_MB",
            "detail_s", "detail_cpu_s", "detail_rays", "peak_MB"]
EDIT = ["elements", "lamps", "scratch_s", "scratch_cpu_s", "update_s", "update_cpu_s", "place_s",
        "follow_s", "settle_s", "time_ratio", "time_ratio_cpu", "scratch_rays", "update_rays",
        "update_rays_full", "update_rays_single", "ray_ratio", "least_rays", "rays_over_minimum",
        "least_own", "least_uncovered", "least_released", "least_met", "least_refined",
        "self_rays", "update_over_bare", "update_over_bare_cpu", "settle_over_bare",
        "own_entries", "entries_changed", "entries", "blocks_visited", "blocks",
        "bytes_per_entry"]
TOTAL = ["patches", "elements", "scratch_s", "scratch_settled_s", "update_s", "update_settled_s",
         "follow_s", "direct_s", "indirect_s", "time_ratio", "time_ratio_settled", "put_off_blocks",
         "put_off_share", "put_off_bound", "rays_until_certified", "scratch_shots", "update_shots",
         "scratch_rays", "update_rays", "direct_rays", "indirect_rays_full", "indirect_rays_single",
         "ray_ratio", "entries_changed", "blocks_visited", "patches_affected", "certificate",
         "emitter_entries", "emitter_bytes_per_entry", "patch_entries", "patch_bytes_per_entry",
         "bytes_per_entry", "rows_MB", "peak_MB"]
DETAIL = ["elements", "nodes", "gatherers", "scratch_s", "update_s", "apply_s", "scratch_rays",
          "update_rays", "ray_ratio", "groups_visited", "groups"]
PLAY = ["patches", "elements", "scratch_s", "updates", "updates_per_s", "update_s", "longest_s"]
STEPS = ["elements", "steps", "over_ms", "over_first_ms", "over_99_ms", "over_thread_ms"]
LATENCY = ["alone_first_ms", "thread_first_ms", "process_first_ms", "thread_first_more_ms",
           "process_first_more_ms", "alone_settle_ms", "thread_settle_ms", "process_settle_ms",
           "thread_settle_ratio", "process_settle_ratio"]
FRAMES = ["idle_ms", "busy_ms", "median_ratio", "idle_99_ms", "busy_99_ms", "ratio_99",
          "update_busy_99_ms", "update_busy_longest_ms", "update_stopped_longest_ms",
          "update_waits"]
SETTLE = ["elements", "plain_ms", "bound_ms", "importance_ms", "bound_time", "importance_time",
          "bound_time_cpu", "importance_time_cpu", "plain_rays", "bound_rays", "importance_rays",
          "moves"]
BUILDING = ["elements", "lamps", "mesh_s", "scratch_s", "scratch_rays", "update_s",
            "update_cpu_s", "follow_s", "update_rays", "update_rays_full", "update_rays_single",
            "entries_changed", "blocks_visited", "entries", "rows_MB", "peak_MB"]
BUILDINGS = ("edit/building/", "edit/lit-building/")
GROWTH = ["update_s", "update_cpu_s", "follow_s", "update_rays", "entries_changed",
          "blocks_visited"]


def figure(value):
    if value == "":
        return ""
    if value >= 1e6:
        return f"{value / 1e6:.3g} M"
    return f"{value:.0f}" if value >= 1000 else f"{value:.3g}"


def rows_of(results, prefix):
    return [r for r in results if r["name"].startswith(prefix) and not r.get("error_occurred")]


def table(results, prefix, columns):
    rows = rows_of(results, prefix)
    if not rows:
        return
    names = [r["name"].removeprefix(prefix).split("/iterations")[0] for r in rows]
    print("\n| | " + " | ".join(names) + " |\n| --- |" + " ---: |" * len(rows))
    for column in columns:
        print(f"| {column} | " + " | ".join(figure(r.get(column, "")) for r in rows) + " |")


def add_growth(results, prefix):
    """Says of each case how its cost compares with that of the first one, as `..._over_first`."""
    rows = rows_of(results, prefix)
    for row in rows:
        for name in GROWTH:
            row[name + "_over_first"] = row[name] / rows[0][name] if rows[0][name] else 0


def run_case(program, name):
    """What Google Benchmark writes of one case, and the stamp of measured.py."""
    stamp = measured.stamp()
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "one.json"
        subprocess.run([program, f"--benchmark_filter=^{name}$", f"--benchmark_out={out}"],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        one = json.loads(out.read_text())
    for result in one["benchmarks"]:
        result.update(stamp)
    return one


def print_tables(results):
    table(results, "direct/", DIRECT)
    table(results, "indirect/", INDIRECT)
    table(results, "edit/direct/", EDIT)
    table(results, "edit/total/", TOTAL)
    table(results, "edit/detail/", DETAIL)
    table(results, "edit/play/", PLAY)
    table(results, "edit/steps/", STEPS)
    table(results, "latency/", LATENCY)
    table(results, "frames/", FRAMES)
    table(results, "settle/", SETTLE)
    for prefix in BUILDINGS:
        table(results, prefix, BUILDING + [name + "_over_first" for name in GROWTH])
    print()
    for result in results:
        if result["name"].startswith(("formFactor/", "occluded/", "order/", "crate/", "text/")):
            rate = f", {result['Mrays_per_s']:.3g} Mrays/s" if "Mrays_per_s" in result else ""
            if "bytes_per_second" in result:
                rate = f", {result['bytes_per_second'] / 1e6:.0f} MB/s"
            if "items_per_second" in result:
                rate = f", {result['items_per_second'] / 1e6:.3g} M/s"
            print(f"{result['name']}: {result['real_time']:.3g} {result['time_unit']}{rate}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("penumbra_bench.json"))
    parser.add_argument("--filter", default=".")
    parser.add_argument("--scene", type=pathlib.Path)
    options = parser.parse_args()
    if options.scene:
        os.environ["PENUMBRA_BENCH_SCENE"] = str(options.scene.resolve())
    program = options.program.resolve()
    listed = subprocess.run([program, "--benchmark_list_tests", f"--benchmark_filter={options.filter}"],
                            check=True, capture_output=True, text=True).stdout.split()
    results, failed = [], False
    for name in listed:
        print(name, file=sys.stderr, flush=True)
        one = run_case(program, name)
        results += one["benchmarks"]
        for result in one["benchmarks"]:
            if result.get("error_occurred"):
                print(f"{name}: {result['error_message']}", file=sys.stderr)
                failed = True
        for prefix in BUILDINGS:
            add_growth(results, prefix)
        measured.write(options.out, results, context=one["context"])  # each time: it may be stopped
    print_tables(results)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
