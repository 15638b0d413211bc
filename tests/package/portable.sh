#!/usr/bin/env bash
# Does the portable archive run where nothing is installed? portable.sh ARCHIVE LIBC WORK
# It is unpacked into an empty root that holds a shell, a C library and Mesa's software OpenGL, and drawn with through EGL.
# LIBC: Debian 11's C library, under which the programs run as well.
set -euo pipefail
archive="$(realpath "$1")" libc="$(realpath "$2")" work="$(realpath -m "$3")"
name="$(basename "$archive" .tar.xz)"
fail() { echo "portable: $*" >&2; exit 1; }

((EUID == 0)) && enter=(chroot) || enter=(unshare -r chroot)
rm -rf "$work"
mkdir -p "$work/root"/{dev,tmp,opt,proc}
tar -xJf "$archive" -C "$work/root/opt"

# with_libraries FILE...: copies files and all libraries that they name to the same places of the root.
with_libraries() {
  local file
  for file in "$@"; do
    { echo "$file"; ldd "$file" | grep -o '/[^ ]*'; } | while read -r one; do
      mkdir -p "$work/root$(dirname "$one")"
      cp -Lu "$one" "$work/root$one"
    done
  done
}
libraries=/usr/lib/x86_64-linux-gnu
with_libraries /lib/x86_64-linux-gnu/lib{c.so.6,m.so.6,dl.so.2,pthread.so.0} /bin/bash /usr/bin/{basename,cat,cut,date,dirname,env,grep,head,ls,mkdir,readlink,rm,sed,tail,timeout,tr} \
  $libraries/libEGL.so.1 $libraries/libEGL_mesa.so.0 $libraries/libGLdispatch.so.0 $libraries/dri/swrast_dri.so
mkdir -p "$work/root/usr/share/glvnd/egl_vendor.d"
cp /usr/share/glvnd/egl_vendor.d/50_mesa.json "$work/root/usr/share/glvnd/egl_vendor.d/"
cp $libraries/dri/swrast_dri.so "$work/root$libraries/dri/kms_swrast_dri.so"
ln -sf bash "$work/root/bin/sh"
: >"$work/root/dev/null"

in_root() { "${enter[@]}" "$work/root" /usr/bin/env -i PATH=/usr/bin:/bin HOME=/tmp LP_NUM_THREADS=1 "$@"; }
folder="/opt/$name"
for library in OpenImageIO glfw embree fmt tinygltf OSMesa; do
  [[ -z $(find "$work/root" -name "lib$library*.so*") ]] || fail "the root holds lib$library"
done

in_root "$folder/bin/gnomon" --version
in_root "$folder/bin/gnomon" doctor >"$work/doctor.txt" || fail "doctor: $(cat "$work/doctor.txt")"
grep -q "EGL.*llvmpipe" "$work/doctor.txt" || fail "doctor names no software through EGL: $(cat "$work/doctor.txt")"
in_root "$folder/bin/flythrough" builtin:fence --frames 2 --size 64x48 --map-size 64 --out /tmp/fly >/dev/null
for file in frame_0001_image.png contact_sheet.png frames.csv; do
  [[ -s $work/root/tmp/fly/$file ]] || fail "flythrough wrote no $file"
done
[[ $(head -c 4 "$work/root/tmp/fly/contact_sheet.png") == $'\x89PNG' ]] || fail "contact_sheet.png is no PNG"

# The same plan under this machine's C library and under glibc 2.31.
case="$work/root$folder/data/cases/light45.json"
program="$work/root$folder/bin/gnomon"
"$program" plan "$case" >"$work/here.json"
"$libc/lib/x86_64-linux-gnu/ld-2.31.so" --library-path "$libc/lib/x86_64-linux-gnu" "$program" plan "$case" >"$work/there.json"
cmp "$work/here.json" "$work/there.json" || fail "plans differ under glibc 2.31"

# Masks of the software that drew masks.bin are equal. By itself: in its time measure_gpu may come to none on a busy machine.
in_root GALLIVM_PERF=nopt "$folder/bin/mask_hashes" --against "$folder/masks.bin" "maps hard" >"$work/masks.jsonl"
[[ $(grep -c '"differ":0,"visibly":0,"other_map":0' "$work/masks.jsonl") == 3 && $(wc -l <"$work/masks.jsonl") == 3 ]] ||
  fail "masks differ from themselves, or are not three: $(cat "$work/masks.jsonl")"

# Bad input: one line, and 2.
refuses() {
  local why="$1" code=0
  shift
  "$@" >"$work/out" 2>"$work/err" || code=$?
  ((code == 2)) || fail "$why: ended with $code: $(cat "$work/err")"
  [[ $(wc -l <"$work/err") == 1 ]] || fail "$why: does not take one line: $(cat "$work/err")"
}
refuses "no seconds" in_root "$folder/measure_gpu" soon
mv "$work/root$libraries/libEGL_mesa.so.0" "$work/mesa"
refuses "no driver" in_root "$folder/measure_gpu" 10 /tmp/none
mv "$work/mesa" "$work/root$libraries/libEGL_mesa.so.0"

in_root "$folder/measure_gpu" "${GNOMON_MEASURE_SECONDS:-60}" /tmp/measured || fail "measure_gpu ended with $?"
rows="$work/root/tmp/measured/gpu.jsonl"
python3 - "$rows" <<'PYTHON'
import json, sys
parts = {}
for line in open(sys.argv[1]):
    row = json.loads(line)
    parts[row["part"]] = parts.get(row["part"], 0) + 1
    # The masks that are compared with were drawn by the same software.
    if "differ" in row and (row["differ"] or row["other_map"]):
        sys.exit(f"portable: masks differ from themselves: {line}")
missing = {"machine", "masks", "filters", "end"} - parts.keys()
if missing:
    sys.exit(f"portable: no rows of {missing}; there are {parts}")
print(parts)
PYTHON
refuses "rows that are there" in_root "$folder/measure_gpu" 10 /tmp/measured
echo "portable: ran in an empty root"
