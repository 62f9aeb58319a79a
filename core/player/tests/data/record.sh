#!/bin/sh
# Records the traces again: needs a C compiler, libGL, libX11, Xvfb and apitrace.
set -eu
cd "$(dirname "$0")"
# A trace holds its program's path, so this one is the same everywhere.
build=/tmp/afterglow-traces
mkdir "$build"
trap 'rm -rf "$build"' EXIT
for name in mapped forms shared; do
	cc -Wall -o "$build/$name" "$name.c" -lGL -lX11 -lpthread
	LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a apitrace trace -o "$build/$name.trace" "$build/$name"
	apitrace repack --brotli=9 "$build/$name.trace" "$name.trace"
done
